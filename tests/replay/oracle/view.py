"""One depth view, and what it knows about uncertain points (paper IV.A.2, with DESIGN.md's statuses)."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from nanomap_log import Status, depth_counts, matrix
from settings import Settings

UNDECIDED = -1
# The module keeps depths and points in single precision: a reading is known to half a unit in its last place.
SINGLE_PRECISION = 2.0**-24


@dataclass(frozen=True)
class Verdicts:
    """Statuses of several points, and how far each was from another status, as a multiple of rounding's reach."""

    status: np.ndarray
    margin: np.ndarray


class Camera:
    def __init__(self, message):
        if any(message.distortion):
            raise ValueError(f"camera '{message.name}' has distortion: the oracle is a plain pinhole")
        self.width, self.height = message.width, message.height
        self.fx, self.fy, self.cx, self.cy = message.fx, message.fy, message.cx, message.cy
        self.unit_m = message.depth_unit
        self.near_m, self.far_m = message.min_range, message.max_range
        self.no_return = message.no_return_values
        self.T_B_C = matrix(message.body_from_camera)
        # Side planes, through the outer edges of the outer pixels, as inward normals in C.
        left, right = (-0.5 - self.cx) / self.fx, (self.width - 0.5 - self.cx) / self.fx
        top, bottom = (-0.5 - self.cy) / self.fy, (self.height - 0.5 - self.cy) / self.fy
        self.side_normals = np.array([[1, 0, -left], [-1, 0, right], [0, 1, -top], [0, -1, bottom]])


class View:
    def __init__(self, image, camera: Camera, settings: Settings):
        self.utime, self.sequence = image.utime, image.sequence
        self.camera = camera
        self._window_px = settings.open_window_px
        self._frame_m = settings.open_frame_m
        self._open_limit_m = settings.open_range_fraction * camera.far_m * (1 + 2 * SINGLE_PRECISION)
        counts = depth_counts(image)
        self.depth_m = counts * camera.unit_m
        self.is_return = ~np.isin(counts, camera.no_return)
        # A count on the limit of the range is inside, whatever the rounding of the unit.
        slack = 2 * SINGLE_PRECISION * camera.far_m
        self.too_far = self.is_return & (self.depth_m > camera.far_m + slack)
        self.too_near = self.is_return & (self.depth_m < camera.near_m - slack)
        self.in_range = self.is_return & ~self.too_far & ~self.too_near

    def points(self) -> np.ndarray:
        """Every in-range return as a point in C, n x 3 [m]."""
        row, column = np.nonzero(self.in_range)
        z = self.depth_m[row, column]
        return np.column_stack([(column - self.camera.cx) / self.camera.fx * z,
                                (row - self.camera.cy) / self.camera.fy * z, z])

    def inside_by(self, mean: np.ndarray, covariance: np.ndarray, around_m: float) -> np.ndarray:
        """How far inside the frustum each point's box is, with `around_m` more on all sides; negative if it is not."""
        half = np.sqrt(np.diagonal(covariance, axis1=1, axis2=2)) + around_m
        # The farthest corner of the box along each plane's inward normal, towards the outside.
        from_sides = mean @ self.camera.side_normals.T - half @ np.abs(self.camera.side_normals).T
        z, half_z = mean[:, 2], half[:, 2]
        return np.minimum.reduce([from_sides.min(axis=1), z - half_z - self.camera.near_m,
                                  self.camera.far_m - z - half_z])

    def classify(self, mean: np.ndarray, covariance: np.ndarray, up: np.ndarray, around_m: float = 0.0) -> Verdicts:
        """Status of each point N(mean[i], covariance[i]) in C; means n x 3 [m], covariances n x 3 x 3 [m^2].

        `up` points against gravity, in C; a view is to hold `around_m` more than a point's box, on all sides."""
        camera = self.camera
        count = len(mean)
        x, y, z = mean.T
        status = np.full(count, UNDECIDED)
        margin = np.full(count, np.inf)
        resolution = 1e-9

        def settle(slack: np.ndarray, verdict: Status, reach: np.ndarray | float = resolution) -> None:
            """Where `slack` is not positive the undecided points get the verdict."""
            open_ = status == UNDECIDED
            margin[open_] = np.minimum(margin, np.abs(slack) / reach)[open_]
            status[open_ & (slack < 0)] = verdict

        settle(z - camera.near_m, Status.BEHIND)
        sides = mean @ camera.side_normals.T
        settle(sides.min(axis=1), Status.OUTSIDE_FOV)
        settle(camera.far_m - z, Status.BEYOND_RANGE)

        inside = np.flatnonzero(status == UNDECIDED)
        if len(inside) == 0:
            return Verdicts(status, margin)
        column_f = camera.fx * x[inside] / z[inside] + camera.cx + 0.5
        row_f = camera.fy * y[inside] / z[inside] + camera.cy + 0.5
        for pixel_f in (column_f, row_f):
            margin[inside] = np.minimum(margin[inside], np.abs(pixel_f - np.round(pixel_f)) / resolution)
        column = np.clip(np.floor(column_f).astype(int), 0, camera.width - 1)
        row = np.clip(np.floor(row_f).astype(int), 0, camera.height - 1)

        contained = self.inside_by(mean, covariance, around_m)

        is_silent = np.zeros(count, dtype=bool)
        is_silent[inside] = ~self.is_return[row, column]
        is_open = is_silent.copy()
        silent = np.flatnonzero(is_silent[inside])
        is_open[inside[silent]] = [not self._something_near(row[i], column[i], z[inside[i]], up) for i in silent]
        status[is_silent & ~is_open] = Status.HOLE
        settle(np.where(is_open, contained, np.inf), Status.PARTIAL)
        status[is_open & (status == UNDECIDED)] = Status.OPEN

        seen = np.full(count, np.inf)
        seen[inside] = np.where(self.too_far[row, column], np.inf, self.depth_m[row, column])
        with np.errstate(invalid="ignore"):
            rounding = np.where(np.isfinite(seen), np.maximum(4 * SINGLE_PRECISION * seen, resolution), resolution)
            settle(np.where(np.isfinite(seen), seen - z, np.inf), Status.OCCLUDED, rounding)
        settle(contained, Status.PARTIAL)
        status[status == UNDECIDED] = Status.FREE
        return Verdicts(status, margin)

    def _something_near(self, row: int, column: int, z: float, up: np.ndarray) -> bool:
        """Whether a return speaks against sky: near and in the window around the pixel, or about as far away as the
        point and beside it like the frame of a pane."""
        in_window = self._is_above(self._is_near, row, column, self._window_px, self._window_px, up)
        in_frame = self._is_near & (self.depth_m <= z + self._frame_m)
        reach_v, reach_u = (int(min(f * self._frame_m / z, 1e6)) for f in (self.camera.fy, self.camera.fx))
        return in_window or self._is_above(in_frame, row, column, reach_v, reach_u, up)

    @staticmethod
    def _is_above(near: np.ndarray, row: int, column: int, reach_v: int, reach_u: int, up: np.ndarray) -> bool:
        """Whether one of the pixels `near` lies in the window at the level of the pixel or above."""
        first_row, first_column = max(row - reach_v, 0), max(column - reach_u, 0)
        rows, columns = np.nonzero(near[first_row:row + reach_v + 1, first_column:column + reach_u + 1])
        rows += first_row - row
        columns += first_column - column
        length = np.hypot(up[0], up[1])
        if length < 1e-3:
            return len(rows) > 0
        return bool(np.any((columns * up[0] + rows * up[1]) / length >= -0.5))

    @cached_property
    def _is_near(self) -> np.ndarray:
        return self.is_return & (self.depth_m <= self._open_limit_m)
