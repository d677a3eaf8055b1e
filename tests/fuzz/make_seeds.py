"""Writes the seeds of the fuzzers into tests/fuzz/corpus, from which they start: small valid inputs of every sort.

Run it when a message type or a section of the configuration is new, with the build's python/ folder and
tests/unit/drivers on PYTHONPATH. Files named regression-* are inputs that once were findings: it leaves them alone.
"""

import json
import pathlib
import struct

import blosc
import nanomap
import numpy as np
from python_log import Filler, PIXELS, WIDTH_PX, HEIGHT_PX, recognisable, type_names

CORPUS = pathlib.Path(__file__).parent / "corpus"
DEFAULT_CONFIGURATION = pathlib.Path(__file__).parents[2] / "firmware_app" / "config" / "default.toml"
KINDS = {"pose": 0, "correction": 1, "camera": 2, "depth": 3, "goal": 4}


def write(fuzzer, seeds):
    folder = CORPUS / fuzzer
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob("seed-*"):
        old.unlink()
    for name, content in seeds.items():
        (folder / f"seed-{name}").write_bytes(content)


def messages():
    filler = Filler()
    seeds = {name: filler.message(message_type, 1).encode() for name, message_type in type_names()}
    seeds.update({channel.lower(): message.encode() for channel, message in recognisable().items()})
    return seeds


def camera():
    message = nanomap.camera_model_t()
    message.name = "front"
    message.width, message.height = WIDTH_PX, HEIGHT_PX
    message.fx = message.fy = 4.0
    message.cx, message.cy = 1.5, 1.0
    message.body_from_camera.rotation = [0.5, -0.5, 0.5, -0.5]
    message.depth_unit, message.max_range = 0.001, 10.0
    return message


def poses():
    for number in range(4):
        message = nanomap.body_pose_t()
        message.utime, message.sequence = 1_000_000 + 10_000 * number, number
        message.world_from_body.translation = [0.1 * number, 0.0, 1.0]
        message.world_from_body.rotation = [1.0, 0.0, 0.0, 0.0]
        yield message


def correction():
    message = nanomap.pose_correction_t()
    for pose in poses():
        corrected = nanomap.stamped_transform_t()
        corrected.utime, corrected.transform = pose.utime, pose.world_from_body
        message.poses.append(corrected)
    message.num_poses = len(message.poses)
    return message


def arrival(kind, message):
    encoded = message.encode()
    return struct.pack(">BH", KINDS[kind], len(encoded)) + encoded


def arrivals():
    known = recognisable()
    flight = [arrival("camera", camera())] + [arrival("pose", pose) for pose in poses()]
    return {
        "flight": b"".join(flight) + arrival("goal", nanomap.goal_t()) + arrival("correction", correction()),
        "plain": arrival("depth", known["RECOGNISABLE_IMAGES"]) + arrival("depth", known["RECOGNISABLE_DEPTH"]),
    }


def event(number, channel, data):
    return struct.pack(">IqqII", 0xEDA1DA01, number, 1000 * number, len(channel), len(data)) + channel + data


def logs():
    whole = event(0, b"POSE_BODY", b"first") + event(1, b"DEPTH", b"second") + event(2, b"POSE_BODY", b"")
    return {"whole": whole, "cut": whole[:-5], "damaged": whole[:40] + b"garbage" + whole[45:], "sync": whole[:4],
            "name": b"flight-000012-part-0003.lcmlog"}


def configurations():
    """One section each: a mutated whole file is mostly refused for its first fault."""
    sections = DEFAULT_CONFIGURATION.read_text().split("\n[")
    seeds = {}
    for section in sections[1:]:
        lines = [line for line in section.splitlines() if line and not line.startswith("#")]
        seeds[lines[0].rstrip("]")] = ("[" + "\n".join(lines) + "\n").encode()
    seeds["override"] = b"history.views=3"
    return seeds


def fields():
    motion = {name: 0.5 for name in ("x", "y", "z", "vx", "vy", "vz")}
    return {
        "heartbeat": {"autopilot": 12, "base_mode": 209, "custom_mode": 393216, "system_status": 4},
        "position": {"time_boot_ms": 12345, **motion},
        "attitude": {"time_boot_ms": 12345, "q1": 1.0, "q2": 0.0, "q3": 0.0, "q4": 0.0},
        "landed": {"landed_state": 2, "null": None},
    }


if __name__ == "__main__":
    write("decode_fuzzer", messages())
    write("depth_codec_fuzzer", {
        "zstd": blosc.compress(PIXELS.tobytes(), typesize=2, cname="zstd"),
        "lz4": blosc.compress(np.zeros(100, "<u2").tobytes(), typesize=2, cname="lz4"),
        "stored": blosc.compress(PIXELS.tobytes(), typesize=2, clevel=0)})
    write("intake_fuzzer", arrivals())
    write("log_fuzzer", logs())
    write("configuration_fuzzer", configurations())
    write("mavlink_json_fuzzer", {name: json.dumps(each).encode() for name, each in fields().items()})
