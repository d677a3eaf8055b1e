"""How well a vehicle kept to the motions that it was told, beside what plans allow for."""

from dataclasses import dataclass
from pathlib import Path

import nanomap
import numpy as np
from inputs import US_PER_S
from limits import TrackingAllowance
from motion import Motion
from nanomap_log import Channels, events
from outcomes import Outcome, outcome

AHEAD_S = (0.2, 0.5, 1.0, 1.5, 2.0)
OF_RETURN = 0.25  # planner/aside.h
LONGEST_GAP_S = 0.2  # without a new decision the vehicle may be in other hands
TOLERANCE = 1.2  # figures of one flight are no better known
SLOWEST_PERIOD_S = 0.1  # of poses that pair
MOST_BEYOND_THREE = 0.01  # 0.0027 of what is normally distributed is
LEAST_SPEED_M_S = 1.0  # slower than that, motions have no direction to be behind in


@dataclass(frozen=True)
class Followed:
    """Moments at which a verified motion was in force, by time: one row each, in W."""

    times_s: np.ndarray
    offsets_m: np.ndarray  # from where the vehicle should be to where it is
    velocities_m_s: np.ndarray  # that it should have
    runs: np.ndarray  # counts on with each interruption: other hands, another world, a motion without a verified brake


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
                self.vertical_m <= TOLERANCE * self.vertical_allowed_m and
                self.beyond_three <= MOST_BEYOND_THREE)


def gather_followed(log: Path, channels: Channels) -> Followed:
    """Raises ValueError naming the log if it holds no flight by verified motions."""
    messages = [event.message for event in events(log, {**channels.decisions(),
                                                        channels.pose_channel: nanomap.body_pose_t})]
    decisions = sorted((m for m in messages if isinstance(m, nanomap.decision_t)), key=lambda m: m.utime)
    poses = sorted((m for m in messages if isinstance(m, nanomap.body_pose_t)), key=lambda m: m.utime)
    in_force = _in_force(decisions)
    if not any(in_force):
        raise ValueError(f"{log}: holds no decisions that were flown by verified motions")
    utimes = np.array([decision.utime for decision in decisions], dtype=np.int64)
    motions = [Motion(decision.brake) if decision else None for decision in in_force]
    rows = []
    run, epoch = 0, None
    for pose in poses:
        index = int(np.searchsorted(utimes, pose.utime, side="right")) - 1
        followed = in_force[index] if index >= 0 else None
        elapsed_s = (pose.utime - followed.utime) / US_PER_S if followed else None
        if not followed or elapsed_s > LONGEST_GAP_S or pose.epoch != followed.epoch:
            epoch = None
            continue
        if pose.epoch != epoch:
            run, epoch = run + 1, pose.epoch
        told = motions[index].at([elapsed_s])
        rows.append((pose.utime / US_PER_S, np.array(pose.world_from_body.translation) - told.position[0],
                     told.velocity[0], run))
    if not rows:
        raise ValueError(f"{log}: holds no poses (nanomap.body_pose_t on {channels.pose_channel}, of the clock that "
                         "decisions are of: lcm.clock = \"monotonic\") from when verified motions were flown")
    return Followed(*(np.array(column) for column in zip(*rows)))


def _in_force(decisions: list[nanomap.decision_t]) -> list[nanomap.decision_t | None]:
    """The verified motion that is flown from each decision on, by planner/receding_horizon.h."""
    found: list[nanomap.decision_t | None] = []
    for decision in decisions:
        before = found[-1] if found else None
        if not decision.flown:
            found.append(None)
        elif decision.has_motion and decision.has_brake:
            found.append(decision)
        elif decision.has_motion and outcome(decision) is not Outcome.NOTHING_VERIFIED:
            found.append(None)  # flown, and not held to anything
        else:
            found.append(before)
    return found


def strayed(followed: Followed, ahead_s: float, allowance: TrackingAllowance) -> Strayed | None:
    """None: no moment is followed by one that much later."""
    before, after = _pairs(followed, ahead_s)
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


def words(followed: Followed, allowance: TrackingAllowance, origin: str) -> str:
    """`origin`: of the allowance. Raises ValueError if the flight is too short."""
    rows = [row for row in (strayed(followed, ahead_s, allowance) for ahead_s in AHEAD_S) if row]
    if not rows:
        raise ValueError(f"no two poses of one flight by verified motions lie {AHEAD_S[0]} s apart")
    lines = [_offsets(followed), "",
             "Off where it was expected, root mean square of one axis, and what plans allow for [m],",
             f"by {origin}:",
             "  after    horizontally       vertically         more than 3 times that (0.27 % if normal)"]
    lines += [f"  {row.ahead_s:.1f} s    {row.horizontal_m:.3f} of {row.horizontal_allowed_m:.3f}     "
              f"{row.vertical_m:.3f} of {row.vertical_allowed_m:.3f}     {100 * row.beyond_three:.2f} %"
              for row in rows]
    if not all(row.is_covered for row in rows):
        lines += ["", "Plans allow for less than this vehicle strays by: raise [risk] horizontal_* or vertical_*, or "
                  "have it follow better", "([mavlink] setpoint_lead_s, tilt_lag_s, drag_1_s)."]
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


def _pairs(followed: Followed, ahead_s: float) -> tuple[np.ndarray, np.ndarray]:
    """Rows of one run that lie `ahead_s` apart, as nearly as the poses' period lets them."""
    times_s = followed.times_s
    if len(times_s) < 2:
        return np.array([], dtype=int), np.array([], dtype=int)
    wanted_s = times_s + ahead_s
    after = np.clip(np.searchsorted(times_s, wanted_s), 1, len(times_s) - 1)
    after -= wanted_s - times_s[after - 1] < times_s[after] - wanted_s
    near = np.abs(times_s[after] - wanted_s) <= min(0.5 * np.median(np.diff(times_s)), SLOWEST_PERIOD_S / 2)
    near &= followed.runs[after] == followed.runs
    return np.flatnonzero(near), after[near]


def _rms(values: np.ndarray) -> float:
    return float(np.sqrt(np.mean(np.square(values))))
