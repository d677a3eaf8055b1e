"""Everything that the depth camera measured on a flight, where the estimator's poses put it."""

from dataclasses import dataclass

import nanomap
import numpy as np
from depth_points import measured_points, transformed
from inputs import US_PER_S
from nanomap_log import matrix
from track import Track

FRAME_EVERY_S = 0.1  # the next frame sees nearly the same
PIXEL_EVERY = 4  # a few centimetres apart where it matters, next to the vehicle
# The estimator drifts: what was measured longer before or after is not where it was.
CLEARANCE_WITHIN_S = 5.0


@dataclass(frozen=True)
class SeenPoints:
    """One row a point, by the time of its frame."""

    utimes: np.ndarray
    positions: np.ndarray  # m, W
    heights: np.ndarray  # m, above the vehicle as it was when it saw the point

    def clearance(self, track: Track, utime: int) -> float:
        """From the body's origin to the nearest measured point [m]; NaN if there is none. Only some of all pixels and
        frames are looked at."""
        first, last = np.searchsorted(self.utimes, utime + np.array([-1, 1]) * round(CLEARANCE_WITHIN_S * US_PER_S))
        away = self.positions[first:last] - track.T_W_B(utime)[:3, 3].astype(np.float32)
        return float(np.sqrt(np.einsum("ij,ij->i", away, away).min())) if len(away) else np.nan


def gather_seen_points(images: list[nanomap.depth_image_t], camera: nanomap.camera_model_t,
                       track: Track) -> SeenPoints:
    """Of the frames that the track covers."""
    T_B_C = matrix(camera.body_from_camera)
    utimes, positions, heights = [np.empty(0, np.int64)], [np.empty((0, 3), np.float32)], [np.empty(0, np.float32)]
    next_utime = -np.inf
    for image in sorted(images, key=lambda image: image.utime):
        if image.utime < next_utime or not track.covers(image.utime):
            continue
        next_utime = image.utime + FRAME_EVERY_S * US_PER_S
        T_W_B = track.T_W_B(image.utime)
        points_W = transformed(T_W_B @ T_B_C, measured_points(image, camera, PIXEL_EVERY)).astype(np.float32)
        utimes.append(np.full(len(points_W), image.utime))
        positions.append(points_W)
        heights.append(points_W[:, 2] - np.float32(T_W_B[2, 3]))
    return SeenPoints(np.concatenate(utimes), np.concatenate(positions), np.concatenate(heights))
