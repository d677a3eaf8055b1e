"""The points that a depth image measured."""

import nanomap
import numpy as np
from nanomap_log import depth_counts


def measured_points(image: nanomap.depth_image_t, camera: nanomap.camera_model_t, every: int = 1) -> np.ndarray:
    """In the camera's frame, n x 3 [m], of every `every`-th row and column. Lens distortion is left out: it moves a
    point by less than a picture shows."""
    counts = depth_counts(image)[::every, ::every]
    depth_m = counts * camera.depth_unit
    row, column = np.nonzero((depth_m >= camera.min_range) & (depth_m <= camera.max_range) &
                             ~np.isin(counts, camera.no_return_values))
    z = depth_m[row, column]
    return np.column_stack([(every * column - camera.cx) / camera.fx * z, (every * row - camera.cy) / camera.fy * z, z])


def transformed(T_A_B: np.ndarray, points_B: np.ndarray) -> np.ndarray:
    """n x 3, in A."""
    return points_B @ T_A_B[:3, :3].T + T_A_B[:3, 3]
