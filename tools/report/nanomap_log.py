"""Reads LCM logs with this project's messages: which type an event holds is told by its bytes, not by its channel."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum
from pathlib import Path
from typing import Any

import blosc
import bot_core
import lcm
import nanomap
import numpy as np

FINGERPRINT_BYTES = 8


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
class Event:
    """One decoded message of a log."""

    log_utime: int  # us
    channel: str
    message: Any


def _message_types() -> dict[bytes, type]:
    types = [getattr(package, name) for package in (bot_core, nanomap) for name in dir(package) if name.endswith("_t")]
    return {message_type._get_packed_fingerprint(): message_type for message_type in types}


def events(path: Path, *types: type) -> Iterator[Event]:
    """Messages of the given types (all known types if none is given), in the log's order.

    Raises ValueError naming the log and the moment of a message that cannot be decoded.
    """
    if not Path(path).is_file():
        raise ValueError(f"{path}: no such log")
    known = _message_types()
    wanted = set(types) or set(known.values())
    for raw in lcm.EventLog(str(path), "r"):
        message_type = known.get(raw.data[:FINGERPRINT_BYTES])
        if message_type not in wanted:
            continue
        try:
            message = message_type.decode(raw.data)
        except (ValueError, IndexError, struct.error) as error:
            raise ValueError(f"{path}: damaged {message_type.__name__} at log time {raw.timestamp} us") from error
        yield Event(raw.timestamp, raw.channel, message)


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
