"""What of the plane a view from above shows."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Frame:
    """A rectangle along x and y [m]."""

    low: np.ndarray
    high: np.ndarray

    @property
    def height_to_width(self) -> float:
        width, height = self.high - self.low
        return height / width

    def holds(self, place: np.ndarray) -> bool:
        return bool(np.all(self.low < place) and np.all(place < self.high))

    def way_out(self, start: np.ndarray, towards: np.ndarray) -> np.ndarray:
        """Where the line from `start`, which is inside, leaves it."""
        away = towards - start
        room = np.where(away > 0, self.high - start, start - self.low)
        return start + away * (room / np.maximum(np.abs(away), np.finfo(float).tiny)).min()


def around(points: np.ndarray, margin_m: float, height_to_width: tuple[float, float]) -> Frame:
    """All of `points` (n x 2) and a margin; more of the shorter side if the shape would be outside the range given."""
    low, high = points.min(axis=0) - margin_m, points.max(axis=0) + margin_m
    (width, height), (lowest, highest) = high - low, height_to_width
    size = np.array([max(width, height / highest), max(height, width * lowest)])
    middle = (low + high) / 2
    return Frame(middle - size / 2, middle + size / 2)
