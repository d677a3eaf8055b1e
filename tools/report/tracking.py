"""How well a vehicle kept to the motions that it was told, beside what plans allow for."""

from dataclasses import dataclass
from pathlib import Path

import nanomap
import numpy as np
from inputs import US_PER_S
from limits import TrackingAllowance
from motion import Motion
from nanomap_log import Channels, events

AHEAD_S = (0.2, 0.5, 1.0, 1.5, 2.0)
OF_RETURN = 0.25  # planner/aside.h
LONGEST_GAP_S = 0.2  # without a new decision the vehicle may be in other hands
TOLERANCE = 1.2  # figures of one flight are no better known
LEAST_SPEED_M_S = 1.0  # slower than that, motions have no direction to be behind in


@dataclass(frozen=True)
class Followed:
    """Moments at which a verified motion was in force, by time: one row each, in W."""

    times_s: np.ndarray
    offsets_m: np.ndarray  # from where the vehicle should be to where it is
    velocities_m_s: np.ndarray  # that it should have


@dataclass(frozen=True)
class Strayed:
    """How far vehicles are from where they were expected some time before, and what plans allow for."""

    ahead_s: float
    horizontal_m: float  # root mean square, of one axis
    horizontal_allowed_m: float  # likewise
    vertical_m: float
    vertical_allowed_m: float
    beyond_three: float  # share, of all axes, that is off by more than three of what is allowed

    @property
    def is_covered(self) -> bool:
        return (self.horizontal_m <= TOLERANCE * self.horizontal_allowed_m and
                self.vertical_m <= TOLERANCE * self.vertical_allowed_m)


def gather_followed(log: Path, channels: Channels) -> Followed:
    """Raises ValueError naming the log if it holds no flight by verified motions."""
    found = events(log, {**channels.decisions(), channels.pose_channel: nanomap.body_pose_t})
    messages = [event.message for event in found]
    decisions = [d for d in messages if isinstance(d, nanomap.decision_t) and d.flown and d.has_motion and d.has_brake]
    decisions.sort(key=lambda decision: decision.utime)
    motions = [Motion(decision.brake) for decision in decisions]
    utimes = np.array([decision.utime for decision in decisions], dtype=np.int64)
    if not decisions:
        raise ValueError(f"{log}: holds no decisions that were flown by verified motions")
    rows = []
    for pose in sorted((m for m in messages if isinstance(m, nanomap.body_pose_t)), key=lambda pose: pose.utime):
        index = int(np.searchsorted(utimes, pose.utime, side="right")) - 1
        elapsed_s = (pose.utime - utimes[index]) / US_PER_S
        if index < 0 or elapsed_s > LONGEST_GAP_S or pose.epoch != decisions[index].epoch:
            continue
        told = motions[index].at([elapsed_s])
        rows.append((pose.utime / US_PER_S, np.array(pose.world_from_body.translation) - told.position[0],
                     told.velocity[0]))
    if not rows:
        raise ValueError(f"{log}: holds no poses from when verified motions were flown")
    times_s, offsets_m, velocities_m_s = zip(*rows)
    return Followed(np.array(times_s), np.array(offsets_m), np.array(velocities_m_s))


def strayed(followed: Followed, ahead_s: float, allowance: TrackingAllowance) -> Strayed | None:
    """None: no moment is followed by one that much later."""
    before, after = _pairs(followed.times_s, ahead_s)
    if len(before) == 0:
        return None
    recovery_s = allowance.recovery_s
    if recovery_s == 0.0:  # plans take it to be where it should be
        left, returned = 0.0, 0.0
    else:
        left = max(0.0, 1.0 - ahead_s / recovery_s)
        returned = OF_RETURN * (1.0 - left)
    residuals_m = followed.offsets_m[after] - left * followed.offsets_m[before]
    speeds_m_s = np.linalg.norm(followed.velocities_m_s[after], axis=1)
    across_m, up_m = (growth.at(speeds_m_s, ahead_s) for growth in (allowance.horizontal, allowance.vertical))
    allowed_m = np.hypot(np.column_stack([across_m, across_m, up_m]), returned * followed.offsets_m[before])
    return Strayed(ahead_s, _rms(residuals_m[:, :2]), _rms(allowed_m[:, :2]), _rms(residuals_m[:, 2]),
                   _rms(allowed_m[:, 2]), float(np.mean(np.abs(residuals_m) > 3.0 * allowed_m)))


def words(followed: Followed, allowance: TrackingAllowance) -> str:
    rows = [row for row in (strayed(followed, ahead_s, allowance) for ahead_s in AHEAD_S) if row]
    lines = [_offsets(followed), "",
             "Off where it was expected, root mean square of one axis, and what plans allow for [m]:",
             "  after    horizontally       vertically         more than 3 times that"]
    lines += [f"  {row.ahead_s:.1f} s    {row.horizontal_m:.3f} of {row.horizontal_allowed_m:.3f}     "
              f"{row.vertical_m:.3f} of {row.vertical_allowed_m:.3f}     {100 * row.beyond_three:.2f} %"
              for row in rows]
    short = [row for row in rows if not row.is_covered]
    if short:
        lines += ["", "Plans allow for less than this vehicle strays by: raise [risk] horizontal_* or vertical_*, or have "
                  "it follow better", "([mavlink] setpoint_lead_s, tilt_lag_s, drag_1_s)."]
    return "\n".join(lines)


def _offsets(followed: Followed) -> str:
    said = (f"Off its motion for {len(followed.times_s):,} poses, root mean square: "
            f"{_rms(np.linalg.norm(followed.offsets_m[:, :2], axis=1)):.3f} m horizontally, "
            f"{_rms(followed.offsets_m[:, 2]):.3f} m vertically")
    speeds_m_s = np.linalg.norm(followed.velocities_m_s, axis=1)
    moves = speeds_m_s >= LEAST_SPEED_M_S
    if not moves.any():
        return said + "."
    ahead_m = np.sum(followed.offsets_m[moves] * followed.velocities_m_s[moves], axis=1) / speeds_m_s[moves]
    mean_m = float(ahead_m.mean())
    return f"{said}; on the way {abs(mean_m):.3f} m {'ahead' if mean_m > 0 else 'behind'} in the mean."


def _pairs(times_s: np.ndarray, ahead_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Rows that lie `ahead_s` apart, as nearly as there are any, and to a hundredth of a second."""
    wanted_s = times_s + ahead_s
    after = np.clip(np.searchsorted(times_s, wanted_s), 1, len(times_s) - 1)
    after -= wanted_s - times_s[after - 1] < times_s[after] - wanted_s
    near = np.abs(times_s[after] - wanted_s) <= 0.01
    return np.flatnonzero(near), after[near]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
