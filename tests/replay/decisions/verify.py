"""One decision against numpy: what its motions are, and what the views know about where they lead.

Strict: the standstill lies in the bubble or in space seen as free, and every one of the planner's samples is within the
chance constraint, priors included. Between the samples nothing is promised about what is seen, but the vehicle must
not touch what was measured: on a grid finer than the samples the nearest measured point of the views asked stays
farther away than the vehicle's radius.
"""

from dataclasses import dataclass, field
from enum import StrEnum

import numpy as np
from evidence import Evidence, Space
from in_force import Start
from motion import Motion
from nanomap_log import Status

# planner/primitive_library.h: their motions are their brakes
BRAKE = 126
IN_FORCE = 127
STOPS = (BRAKE, IN_FORCE)

ROUNDING = 1e-9  # metres and seconds, of double precision after some pieces
SINGLE_M = 5e-5  # the module measures distances in single precision
GRID_M = 0.05  # an eighth of the vehicle's radius

# A risk is told as a bound: above the exact tail up to this factor (planner/collision_probability.h), below it only by
# what single precision does to a distance and quadrature to a tail.
LOOSEST = 2.3
UNDERSTATED = 1e-3
RISK_ROUNDING = 1e-8
LEFT_OUT = 1e-9  # of a sample, by points beyond the reach that matters


class Fault(StrEnum):
    CONSUMED = "consumed other inputs"
    START = "does not start at the vehicle's state"
    LIMITS = "exceeds a limit of acceleration, jerk or time"
    IN_FORCE = "is not what is left of the motion in force"
    SHARED = "the brake leaves the motion too early"
    REST = "the brake does not end at rest"
    END = "the brake ends where nothing is seen as free"
    TOUCHES = "comes nearer to a measured point than the vehicle's radius"
    UNSEEN = "leads through what is not seen as free"
    OVERSTEPS = "more risk than the chance constraint allows"
    UNDERSTATES = "understates its risk"
    OVERSTATES = "overstates its risk beyond the bound's looseness"


@dataclass
class Verified:
    faults: list[tuple[Fault, str]] = field(default_factory=list)
    end_clearance_m: float = np.inf
    clearance_m: float = np.inf  # on the grid
    exact_risk: float = 0.0
    exact_brake_risk: float = 0.0
    end_in_bubble: bool = False
    grid_points: int = 0
    grid_unseen: int = 0  # grid points, between samples, outside the bubble and not seen as free
    grid_holes: int = 0
    ambiguous: bool = False  # a status behind one of the faults hangs on rounding


def verify(decision, pose, start: Start, space: Space) -> Verified:
    """`pose` is the body_pose_t message that the decision consumed, `start` what its motions begin with."""
    result = Verified()
    trajectory, brake = Motion(decision.trajectory), Motion(decision.brake)
    _verify_motions(decision, pose, start, trajectory, brake, space.settings, result.faults)
    result.exact_risk = _verify_risk("motion", trajectory, space.settings.samples, decision.risk, space, result)[0]
    steps = space.settings.samples if decision.primitive in STOPS else space.settings.brake_samples
    result.exact_brake_risk, samples = _verify_risk("brake", brake, steps, decision.brake_risk, space, result)
    _verify_end(samples, space.settings.radius_m, result)
    for name, motion in (("motion", trajectory), ("brake", brake)):
        _verify_grid(name, motion, space, result)
    return result


def _verify_motions(decision, pose, start: Start, trajectory: Motion, brake: Motion, settings,
                    faults: list) -> None:
    def add(fault: Fault, detail: str):
        faults.append((fault, detail))

    told = (decision.utime, decision.pose_sequence, decision.epoch)
    if told != (pose.utime, pose.sequence, pose.epoch):
        add(Fault.CONSUMED, f"stamp, pose and epoch {told}, not {(pose.utime, pose.sequence, pose.epoch)}")
    for name, motion in (("motion", trajectory), ("brake", brake)):
        begin = motion.boundaries()
        if motion.utime != pose.utime or not _close(begin.position[0], start.position):
            add(Fault.START, f"{name}: {motion.utime} us at {begin.position[0]}")
        for told, sent in ((begin.velocity[0], start.velocity), (begin.acceleration[0], start.acceleration)):
            if np.all(np.isfinite(sent)) and not _close(told, sent):
                add(Fault.START, f"{name}: {told} instead of {sent}")

    end = brake.boundaries()
    speed = float(np.linalg.norm(trajectory.boundaries().velocity[0]))
    full, vertical = settings.horizontal_at_full_m_s2, settings.vertical_m_s2
    if decision.primitive not in STOPS:
        horizontal = settings.horizontal_limit_m_s2(speed)
        faults += _limit_faults("motion", trajectory, horizontal, vertical, settings.jerk_m_s3, 0.0)
        if abs(trajectory.duration - settings.horizon_s(speed)) > ROUNDING:
            add(Fault.LIMITS, f"motion: {trajectory.duration} s, not {settings.horizon_s(speed)} s")
    shared_s = 0.0 if decision.primitive in STOPS else settings.brake_after_s
    faults += _limit_faults("brake", brake, full, vertical, settings.jerk_m_s3, shared_s)

    shared = np.linspace(0, trajectory.duration if decision.primitive in STOPS else settings.brake_after_s, 26)
    for one, other in zip(_fields(trajectory.at(shared)), _fields(brake.at(shared))):
        if not _close(one, other):
            add(Fault.SHARED, f"by {np.abs(one - other).max()}")
    if decision.primitive == IN_FORCE:
        faults += _in_force_faults(brake, start)
    for name, rest in (("velocity", end.velocity[-1]), ("acceleration", end.acceleration[-1])):
        if np.abs(rest).max() > ROUNDING * (1 + np.abs(end.acceleration).max() + np.abs(end.velocity).max()):
            add(Fault.REST, f"{name} {rest}")


def _in_force_faults(brake: Motion, start: Start) -> list:
    if start.in_force is None:
        return [(Fault.IN_FORCE, "nothing is")]
    elapsed = np.linspace(0, brake.duration, 26)
    told, kept = brake.at(elapsed), start.in_force.at(start.passed_s + elapsed)
    return [(Fault.IN_FORCE, f"by {np.abs(one - other).max()}") for one, other in zip(_fields(told), _fields(kept))
            if not _close(one, other)]


def _limit_faults(name: str, motion: Motion, horizontal: float, vertical: float, jerk: float, shared_s: float) -> list:
    """At the pieces' ends, between which the acceleration is linear. The first ramp, and what a brake shares with its
    motion until `shared_s`, may come from any acceleration that the vehicle has, never above it."""
    faults = []
    hardest = np.linalg.norm(motion.jerks, axis=1).max(initial=0.0)
    if hardest > jerk + ROUNDING * jerk:
        faults.append((Fault.LIMITS, f"{name}: jerk {hardest} m/s^3"))
    at = motion.boundaries()
    for size, limit in ((np.linalg.norm(at.acceleration[:, :2], axis=1), horizontal),
                        (np.abs(at.acceleration[:, 2]), vertical)):
        inherited = motion.starts <= shared_s + ROUNDING
        allowed = np.where(inherited, max(limit, size[0]), limit)
        if np.any(size > allowed + ROUNDING * (1 + allowed)):
            faults.append((Fault.LIMITS, f"{name}: accelerations {size} m/s^2 above {allowed}"))
    return faults


def _verify_risk(name: str, motion: Motion, steps: int, told: float, space: Space,
                 result: Verified) -> tuple[float, Evidence]:
    samples = space.on_samples(motion, steps)
    exact = samples.whole_risk()
    settings = space.settings
    unseen = np.flatnonzero(~samples.seen_free & (settings.prior[samples.status] > settings.max_risk))
    for i in unseen[:1]:
        result.faults.append((Fault.UNSEEN, f"{name}: {Status(samples.status[i]).name} at {samples.elapsed[i]:.4f} s"))
    result.ambiguous |= bool(samples.ambiguous[unseen].any())
    if exact > settings.max_risk * (1 + UNDERSTATED) or told > settings.max_risk:
        result.faults.append((Fault.OVERSTEPS, f"{name}: exact {exact:.3e}, told {told:.3e}"))
    if told < exact * (1 - UNDERSTATED) - RISK_ROUNDING - LEFT_OUT * len(samples.elapsed):
        result.faults.append((Fault.UNDERSTATES, f"{name}: exact {exact:.3e}, told {told:.3e}"))
    if told > exact * LOOSEST * (1 + UNDERSTATED) + RISK_ROUNDING:
        result.faults.append((Fault.OVERSTATES, f"{name}: exact {exact:.3e}, told {told:.3e}"))
    return exact, samples


def _verify_end(samples: Evidence, radius_m: float, result: Verified) -> None:
    result.end_in_bubble = bool(samples.in_bubble[-1])
    result.end_clearance_m = float(samples.nearest[-1] - radius_m)
    if not samples.seen_free[-1]:
        result.faults.append((Fault.END, f"{Status(samples.status[-1]).name} at {samples.position_W[-1]}"))
        result.ambiguous |= bool(samples.ambiguous[-1])


def _verify_grid(name: str, motion: Motion, space: Space, result: Verified) -> None:
    grid = space.on(motion, motion.dense_times(GRID_M), reach_m=2 * space.settings.radius_m)
    clearance = grid.nearest - space.settings.radius_m
    at = int(np.argmin(clearance))
    if clearance[at] < -SINGLE_M:
        result.faults.append((Fault.TOUCHES, f"{name}: by {-clearance[at]:.4f} m at {grid.elapsed[at]:.4f} s, where "
                                             f"the view says {Status(grid.status[at]).name}"))
        result.ambiguous |= bool(grid.ambiguous[at])
    result.clearance_m = min(result.clearance_m, float(clearance[at]))
    result.grid_points += len(grid.elapsed)
    result.grid_unseen += int(np.count_nonzero(~grid.seen_free))
    result.grid_holes += int(np.count_nonzero(~grid.seen_free & (grid.status == Status.HOLE)))


def _fields(states):
    return states.position, states.velocity, states.acceleration


def _close(a, b) -> bool:
    a, b = np.asarray(a), np.asarray(b)
    return bool(np.all(np.abs(a - b) <= ROUNDING * (1 + np.abs(b))))
