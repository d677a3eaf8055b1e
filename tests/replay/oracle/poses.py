"""The estimator's poses by time, and corrections as deltas on them (DESIGN.md "Correction")."""

from bisect import bisect_left
from dataclasses import dataclass

import numpy as np
import rigid
from nanomap_log import matrix


@dataclass(frozen=True)
class StampedPose:
    utime: int
    epoch: int
    sequence: int
    T_W_B: np.ndarray
    drift_rate_W: np.ndarray | None  # m^2/us: the increment covariance over the time that it spans


class BetweenWorlds(Exception):
    """The estimator's world jumped between the two poses around the stamp."""


class PoseGap(Exception):
    """The two poses around the stamp are too far apart."""


class PoseHistory:
    def __init__(self, capacity: int, max_gap_us: int):
        self._capacity, self._max_gap_us = capacity, max_gap_us
        self._poses: list[StampedPose] = []

    def __len__(self) -> int:
        return len(self._poses)

    @property
    def newest(self) -> StampedPose:
        return self._poses[-1]

    @property
    def oldest(self) -> StampedPose:
        return self._poses[0]

    def insert(self, message) -> bool:
        """Whether the pose is taken: finite, unit, new, and no step back to an older world."""
        rotation = np.array(message.world_from_body.rotation)
        finite = np.all(np.isfinite(rotation)) and np.all(np.isfinite(message.world_from_body.translation))
        if not finite or abs(np.linalg.norm(rotation) - 1) > 0.001:
            return False
        at = bisect_left(self._poses, message.utime, key=lambda pose: pose.utime)
        if at < len(self._poses) and self._poses[at].utime == message.utime:
            return False
        full = len(self._poses) == self._capacity
        if full and at == 0:
            return False
        if at > 0 and self._poses[at - 1].epoch > message.epoch:
            return False
        if at < len(self._poses) and self._poses[at].epoch < message.epoch:
            return False
        T_W_B = matrix(message.world_from_body)
        pose = StampedPose(message.utime, message.epoch, message.sequence, T_W_B, _drift_rate(message))
        self._poses.insert(at, pose)
        if full:
            del self._poses[0]
        return True

    def at(self, utime: int) -> tuple[np.ndarray, int]:
        """T_W_B and epoch at a stamp from the oldest pose to the newest. Raises BetweenWorlds or PoseGap."""
        i = bisect_left(self._poses, utime, key=lambda pose: pose.utime)
        after = self._poses[i]
        if after.utime == utime:
            return after.T_W_B, after.epoch
        before = self._poses[i - 1]
        if before.epoch != after.epoch:
            raise BetweenWorlds
        if after.utime - before.utime > self._max_gap_us:
            raise PoseGap
        weight = (utime - before.utime) / (after.utime - before.utime)
        return rigid.interpolate(before.T_W_B, after.T_W_B, weight), after.epoch

    def drift(self, older_utime: int, newer_utime: int) -> np.ndarray | None:
        """Covariance in W [m^2] that the increments in the messages add up to; None if one of them is missing.

        The time between two poses drifts at the rate of the later one's increment.
        """
        total = np.zeros((3, 3))
        for before, pose in zip(self._poses, self._poses[1:]):
            overlap = min(newer_utime, pose.utime) - max(older_utime, before.utime)
            if overlap > 0:
                if pose.drift_rate_W is None:
                    return None
                total += overlap * pose.drift_rate_W
        return total

    def covers(self, utime: int) -> bool:
        return len(self._poses) > 0 and self.oldest.utime <= utime <= self.newest.utime


def _drift_rate(message) -> np.ndarray | None:
    span_us = message.utime - message.increment_since_utime
    if not message.has_increment_covariance or span_us <= 0:
        return None
    covariance = np.reshape(message.increment_covariance, (3, 3))
    is_covariance = np.allclose(covariance, covariance.T, rtol=1e-9) and np.linalg.eigvalsh(covariance).min() >= 0
    return covariance / span_us if is_covariance else None


@dataclass(frozen=True)
class Anchor:
    utime: int
    epoch: int  # of the original pose
    T_new_old: np.ndarray


class CorrectionWindow:
    """What one correction makes of original poses."""

    def __init__(self, message, poses: PoseHistory):
        self.epoch = message.epoch
        self.anchors = []
        for corrected in message.poses:
            if not poses.covers(corrected.utime):
                continue
            try:
                T_old_B, epoch = poses.at(corrected.utime)
            except (BetweenWorlds, PoseGap):
                continue
            T_new_old = matrix(corrected.transform) @ rigid.inverse(T_old_B)
            self.anchors.append(Anchor(corrected.utime, epoch, T_new_old))

    def reaches_inside(self, utime: int) -> bool:
        return self.anchors[0].utime <= utime <= self.anchors[-1].utime

    def delta(self, utime: int, epoch: int) -> np.ndarray | None:
        """T_new_old for a pose of `epoch`; None before the window, or for a world that the window does not know."""
        if utime < self.anchors[0].utime:
            return None
        if utime > self.anchors[-1].utime:
            if self.anchors[-1].epoch == epoch:
                return self.anchors[-1].T_new_old
            return np.eye(4) if epoch == self.epoch else None  # the stream has moved to the corrected world itself
        before = [a for a in self.anchors if a.utime <= utime][-1]
        after = [a for a in self.anchors if a.utime >= utime][0]
        if before.epoch == after.epoch == epoch:
            span = after.utime - before.utime
            weight = (utime - before.utime) / span if span else 0.0
            return rigid.interpolate(before.T_new_old, after.T_new_old, weight)
        for anchor in (before, after):  # a jump between the two: each side has its own world's delta
            if anchor.epoch == epoch:
                return anchor.T_new_old
        return None
