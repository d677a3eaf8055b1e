"""Where the vehicle was: the log's poses, interpolated."""

import nanomap
import numpy as np
from inputs import US_PER_S
from nanomap_log import rotation_matrix


class Track:
    """The poses of one epoch, by time."""

    def __init__(self, poses: list[nanomap.body_pose_t]):
        unique = {pose.utime: pose for pose in sorted(poses, key=lambda pose: pose.utime)}
        self.utimes = np.array(list(unique), dtype=np.int64)
        self.positions = np.array([pose.world_from_body.translation for pose in unique.values()]).reshape(-1, 3)
        velocities = np.array([pose.velocity for pose in unique.values()]).reshape(-1, 3)
        self.speeds = _speeds(self.utimes, self.positions, velocities)  # m/s
        self._quaternions = np.array([pose.world_from_body.rotation for pose in unique.values()]).reshape(-1, 4)

    def covers(self, utime: int) -> bool:
        return len(self.utimes) > 0 and self.utimes[0] <= utime <= self.utimes[-1]

    @property
    def length_m(self) -> float:
        return float(np.linalg.norm(np.diff(self.positions, axis=0), axis=1).sum())

    def T_W_B(self, utime: int) -> np.ndarray:
        """As a 4x4 matrix; between two poses linear, which a picture cannot tell from slerp."""
        after = int(np.searchsorted(self.utimes, utime))
        before = max(after - 1, 0) if self.utimes[after] != utime else after
        span = self.utimes[after] - self.utimes[before]
        weight = (utime - self.utimes[before]) / span if span else 0.0
        quaternions = self._quaternions[[before, after]]
        if quaternions[0] @ quaternions[1] < 0:
            quaternions[1] *= -1
        T = np.eye(4)
        T[:3, :3] = rotation_matrix((1 - weight) * quaternions[0] + weight * quaternions[1])
        T[:3, 3] = (1 - weight) * self.positions[before] + weight * self.positions[after]
        return T


def _speeds(utimes: np.ndarray, positions: np.ndarray, velocities: np.ndarray) -> np.ndarray:
    """What the estimator says, or, where it gives no velocity, what its positions do."""
    told = np.linalg.norm(velocities, axis=1)
    if len(utimes) < 2:
        return told
    moved = np.linalg.norm(np.gradient(positions, utimes / US_PER_S, axis=0), axis=1)
    return np.where(np.isfinite(told), told, moved)
