"""Reads LCM logs of this project's own messages."""

from __future__ import annotations

import struct
import tomllib
from dataclasses import dataclass, fields
from enum import IntEnum
from pathlib import Path
from typing import Any

import blosc
import lcm
import nanomap
import numpy as np

FINGERPRINT_BYTES = 8
CONFIGURATION_CHANNEL = "NANOMAP_CONFIG"  # firmware_app/configuration/configuration.h


class Status(IntEnum):
    """core/status.h, in its order."""

    FREE = 0
    PARTIAL = 1
    OPEN = 2
    HOLE = 3
    OCCLUDED = 4
    BEYOND_RANGE = 5
    OUTSIDE_FOV = 6
    BEHIND = 7
    EMPTY = 8


@dataclass(frozen=True)
class Channels:
    """Where the module's messages are; the defaults are those of the configuration's section [lcm]."""

    depth_channel: str = "DEPTH"
    pose_channel: str = "POSE_BODY"
    correction_channel: str = "POSE_CORRECTION"
    camera_channel: str = "CAMERA"
    goal_channel: str = "GOAL"
    answers_channel: str = "NANOMAP_ANSWERS"
    decisions_channel: str = "NANOMAP_DECISIONS"
    health_channel: str = "NANOMAP_HEALTH"

    def inputs(self) -> dict[str, type]:
        """Channel -> message type of what a replay takes in."""
        return {
            self.depth_channel: nanomap.depth_image_t,
            self.pose_channel: nanomap.body_pose_t,
            self.correction_channel: nanomap.pose_correction_t,
            self.camera_channel: nanomap.camera_model_t,
        }

    def goals(self) -> dict[str, type]:
        return {self.goal_channel: nanomap.goal_t}

    def answers(self) -> dict[str, type]:
        return {self.answers_channel: nanomap.answers_t}

    def decisions(self) -> dict[str, type]:
        return {self.decisions_channel: nanomap.decision_t}

    def healths(self) -> dict[str, type]:
        return {self.health_channel: nanomap.health_t}


def read_told(config: Path | None) -> dict:
    """What a configuration file tells, section by section; None: nothing."""
    return tomllib.loads(config.read_text()) if config else {}


def read_channels(told: dict) -> Channels:
    """The channels that a configuration tells, and the defaults of the others."""
    section = told.get("lcm", {})
    return Channels(**{field.name: section[field.name] for field in fields(Channels) if field.name in section})


@dataclass(frozen=True)
class Event:
    """One decoded message of a log."""

    log_utime: int  # us
    channel: str
    message: Any


def log_files(path: Path) -> list[Path]:
    """A folder of recordings stands for the parts of the latest flight in it, as for nanomap-replay.

    Raises ValueError naming what is not there.
    """
    if path.is_file():
        return [path]
    if not path.is_dir():
        raise ValueError(f"{path}: no such log")
    parts = sorted(path.glob("flight-*-part-*.lcmlog"))
    if not parts:
        raise ValueError(f"{path}: holds no recording of a flight")
    flight, _, _ = parts[-1].name.partition("-part-")
    return [part for part in parts if part.name.startswith(f"{flight}-")]


def events(path: Path, types: dict[str, type]) -> list[Event]:
    """The messages on the channels of `types`, by log time. Other types on those channels are passed over.

    `path` is a log, or a folder of recordings. Raises ValueError naming the log and the moment of a message that cannot
    be decoded.
    """
    found = []
    for raw in (event for file in log_files(path) for event in lcm.EventLog(str(file), "r")):
        message_type = types.get(raw.channel)
        if message_type is None or raw.data[:FINGERPRINT_BYTES] != message_type._get_packed_fingerprint():
            continue
        try:
            found.append(Event(raw.timestamp, raw.channel, message_type.decode(raw.data)))
        except (ValueError, IndexError, struct.error) as error:
            raise ValueError(f"{path}: damaged {message_type.__name__} at log time {raw.timestamp} us") from error
    return sorted(found, key=lambda event: event.log_utime)


@dataclass(frozen=True)
class Configuration:
    told: dict  # section by section; what is not in it is the module's default
    origin: str


def choose_configuration(log: Path, config: Path | None) -> Configuration:
    """As nanomap-replay chooses: the file, else what the log was recorded with, else the defaults."""
    if config:
        return Configuration(read_told(config), str(config))
    recorded = events(log, {CONFIGURATION_CHANNEL: nanomap.text_t})
    if recorded:
        return Configuration(tomllib.loads(recorded[0].message.text), "the configuration it was recorded with")
    return Configuration({}, "the defaults")


def depth_counts(image: nanomap.depth_image_t) -> np.ndarray:
    """The raw counts of a depth image: uint16, shape (height, width)."""
    match image.compression:
        case nanomap.depth_image_t.RAW:
            data = image.data
        case nanomap.depth_image_t.BLOSC:
            data = blosc.decompress(image.data)
        case other:
            raise ValueError(f"depth image {image.sequence}: unknown compression {other}")
    counts = np.frombuffer(data, dtype="<u2")
    if counts.size != image.height * image.width:
        raise ValueError(f"depth image {image.sequence}: {counts.size} values for {image.width}x{image.height} px")
    return counts.reshape(image.height, image.width)


def rotation_matrix(quaternion) -> np.ndarray:
    """R_A_B of the unit quaternion w, x, y, z."""
    w, x, y, z = np.asarray(quaternion, dtype=float) / np.linalg.norm(quaternion)
    return np.array([
        [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
        [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
        [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
    ])


def matrix(transform: nanomap.transform_t) -> np.ndarray:
    """T_A_B as a homogeneous 4x4 matrix."""
    T_A_B = np.eye(4)
    T_A_B[:3, :3] = rotation_matrix(transform.rotation)
    T_A_B[:3, 3] = transform.translation
    return T_A_B
