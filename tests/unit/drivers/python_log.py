"""Writes and checks LCM logs with Python's own liblcm and generated types, for the tests of drivers/.

write LOG                   messages of every type, filled by introspection, and a few with recognisable values
check EXAMPLE REWRITTEN     every field of every message of EXAMPLE is in REWRITTEN, which C++ decoded and encoded
                            again; what C++ made by itself has the expected values
"""

import sys
import zlib

import blosc
import bot_core
import lcm
import nanomap
import numpy as np

PACKAGES = {"bot_core": bot_core, "nanomap": nanomap}
LENGTHS = (0, 1, 3)
WIDTH_PX, HEIGHT_PX = 4, 3
PIXELS = (np.arange(WIDTH_PX * HEIGHT_PX, dtype="<u2") * 5461).reshape(HEIGHT_PX, WIDTH_PX)


def type_names():
    return [(name, getattr(package, name))
            for package in PACKAGES.values() for name in sorted(vars(package)) if name.endswith("_t")]


class Filler:
    """Fills messages with values that no two fields share."""

    def __init__(self):
        self.count = 0

    def scalar(self, type_name, length):
        self.count += 1
        k = self.count
        if type_name == "int8_t":
            return k % 127
        if type_name == "int16_t":
            return -k
        if type_name in ("int32_t", "int64_t"):
            return k * 65_537
        if type_name in ("float", "double"):
            return k / 8
        if type_name == "boolean":
            return k % 2 == 0
        if type_name == "string":
            return f"näme {k}"
        package, name = type_name.split(".")
        return self.message(getattr(PACKAGES[package], name), length)

    def array(self, type_name, sizes, length):
        if type_name == "byte":
            self.count += 1
            return bytes((self.count + i) % 256 for i in range(sizes[0]))
        if not sizes:
            return self.scalar(type_name, length)
        return [self.array(type_name, sizes[1:], length) for _ in range(sizes[0])]

    def message(self, message_type, length):
        message = message_type()
        lengths = {d for dims in message_type.__dimensions__ if dims for d in dims if isinstance(d, str)}
        for name, type_name, dims in zip(message_type.__slots__, message_type.__typenames__,
                                         message_type.__dimensions__):
            if name in lengths:
                value = length
            else:
                value = self.array(type_name, [length if isinstance(d, str) else d for d in dims or []], length)
            setattr(message, name, value)
        return message


def recognisable():
    """Messages whose values the C++ tests know."""
    pose = nanomap.body_pose_t()
    pose.utime, pose.sequence, pose.epoch = 1_000_000, 7, 2
    pose.world_from_body.translation = [1.0, 2.0, 3.0]
    pose.world_from_body.rotation = [0.5, 0.5, -0.5, 0.5]
    pose.has_increment_covariance = True
    pose.increment_since_utime = 990_000
    pose.increment_covariance = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0]

    depth = nanomap.depth_image_t()
    depth.utime, depth.sequence, depth.camera = 2_000_000, 8, "front"
    depth.width, depth.height, depth.depth_unit = WIDTH_PX, HEIGHT_PX, 0.0001
    depth.compression = nanomap.depth_image_t.BLOSC
    depth.data = blosc.compress(PIXELS.tobytes(), typesize=2, cname="zstd")
    depth.size = len(depth.data)

    return {"RECOGNISABLE_POSE": pose, "RECOGNISABLE_DEPTH": depth,
            "RECOGNISABLE_IMAGES": images(bot_core.images_t.DEPTH_MM, PIXELS.tobytes()),
            "RECOGNISABLE_IMAGES_ZIPPED": images(bot_core.images_t.DEPTH_MM_ZIPPED, zlib.compress(PIXELS.tobytes()))}


def images(depth_type, depth_bytes):
    """A colour and a depth image, as public RGB-D publishers send them."""
    colour, depth = bot_core.image_t(), bot_core.image_t()
    colour.pixelformat = bot_core.image_t.PIXEL_FORMAT_MJPEG
    depth.width, depth.height, depth.row_stride = WIDTH_PX, HEIGHT_PX, 2 * WIDTH_PX
    depth.pixelformat = bot_core.image_t.PIXEL_FORMAT_INVALID
    depth.data, depth.size = depth_bytes, len(depth_bytes)
    message = bot_core.images_t()
    message.utime = 3_000_000
    message.n_images, message.images = 2, [colour, depth]
    message.image_types = [bot_core.images_t.LEFT, depth_type]
    return message


def write(path):
    log = lcm.EventLog(path, "w", overwrite=True)
    filler = Filler()
    utime = 0
    for length in LENGTHS:
        for name, message_type in type_names():
            utime += 1
            log.write_event(utime, name, filler.message(message_type, length).encode())
    for channel, message in recognisable().items():
        utime += 1
        log.write_event(utime, channel, message.encode())
    log.close()


def same(a, b, where):
    if hasattr(a, "__slots__"):
        for name in a.__slots__:
            same(getattr(a, name), getattr(b, name), f"{where}.{name}")
    elif isinstance(a, (list, tuple)):
        assert len(a) == len(b), f"{where}: {len(a)} elements, then {len(b)}"
        for i, (x, y) in enumerate(zip(a, b)):
            same(x, y, f"{where}[{i}]")
    else:
        assert a == b, f"{where}: {a!r}, then {b!r}"


def check_made_by_cpp(event):
    depth = nanomap.depth_image_t.decode(event.data)
    assert (depth.utime, depth.sequence, depth.camera) == (4_000_000, 9, "rear"), "header of the depth image"
    assert (depth.width, depth.height, depth.depth_unit) == (WIDTH_PX, HEIGHT_PX, 0.001), "size of the depth image"
    assert depth.compression == nanomap.depth_image_t.BLOSC, "compression of the depth image"
    pixels = np.frombuffer(blosc.decompress(depth.data), dtype="<u2").reshape(HEIGHT_PX, WIDTH_PX)
    assert (pixels == PIXELS).all(), "pixels of the depth image"


def check(example_path, rewritten_path):
    types = dict(type_names())
    example = list(lcm.EventLog(example_path, "r"))
    rewritten = list(lcm.EventLog(rewritten_path, "r"))
    typed = [event for event in example if event.channel in types]
    assert len(typed) == len(LENGTHS) * len(types) and types, f"{len(typed)} messages of {len(types)} types"
    assert len(rewritten) == len(typed) + 1, f"{len(rewritten)} events were rewritten of {len(typed)}"
    for number, (before, after) in enumerate(zip(typed, rewritten)):
        where = f"event {number}, {before.channel}"
        assert after.eventnum == number, f"{where}: numbered {after.eventnum}"
        assert after.channel == before.channel, f"{where}: now on {after.channel}"
        assert after.timestamp == before.timestamp, f"{where}: logged at {after.timestamp}"
        message_type = types[before.channel]
        same(message_type.decode(before.data), message_type.decode(after.data), where)
    check_made_by_cpp(rewritten[-1])


if __name__ == "__main__":
    {"write": write, "check": check}[sys.argv[1]](*sys.argv[2:])
