"""Checks every decision of a replay whose brake was verified, frame by frame."""

from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

import nanomap
import numpy as np
from chain import Chain
from check_answers import feed
from evidence import Space
from in_force import InForce
from nanomap_log import events, read_channels, read_told
from planner_settings import read_planner_settings
from planted import PLANTED, plant
from settings import read_settings
from verify import Verified, verify

# Right decisions to try a planted fault on before it counts as one that the log has no place for.
TRIES = 240


@dataclass
class Outcome:
    decisions: int = 0
    verified: int = 0
    reasons: Counter = field(default_factory=Counter)
    ambiguous: int = 0
    faults: list[str] = field(default_factory=list)
    planted: dict[str, bool] = field(default_factory=dict)
    results: list[Verified] = field(default_factory=list)

    def summary(self) -> str:
        r = self.results
        if not r:
            return f"{self.decisions} decisions, none with a verified brake: {dict(self.reasons)}"
        return "\n".join([
            f"{self.decisions} decisions, {self.verified} with a verified brake: {dict(self.reasons)}",
            f"standstill: {sum(v.end_in_bubble for v in r)} in the bubble; nearest measured point "
            f"{min(v.end_clearance_m for v in r):.3f} m from the vehicle's surface",
            f"grid: {sum(v.grid_points for v in r)} points, smallest clearance {min(v.clearance_m for v in r):.4f} m; "
            f"between samples {sum(v.grid_unseen for v in r)} points not seen as free, {sum(v.grid_holes for v in r)} "
            f"of them holes, in {sum(v.grid_unseen > 0 for v in r)} decisions",
            f"risk: largest exact {max(v.exact_risk for v in r):.3e} of a motion, "
            f"{max(v.exact_brake_risk for v in r):.3e} of a brake",
            f"planted faults: {sum(self.planted.values())} of {len(self.planted)} seen; no place for "
            f"{sorted(set(PLANTED) - set(self.planted))}; {self.ambiguous} hang on rounding",
        ])


def check(log: Path, decisions: Path, config: Path, overrides: list[str]) -> Outcome:
    """Replays `log` step by step, by log time. A decision follows each input that let a view into the chain.

    Raises ValueError if the decisions do not follow the inputs.
    """
    chain = Chain(read_settings(config, overrides))
    settings = read_planner_settings(config, overrides)
    channels = read_channels(read_told(config))
    outcome = Outcome()
    in_force = InForce(settings)
    cameras, poses, points = {}, {}, {}
    tries = Counter()
    told = (event.message for event in events(decisions, channels.decisions()))
    for event in events(log, channels.inputs()):
        if isinstance(event.message, nanomap.body_pose_t):
            poses.setdefault(event.message.utime, event.message)
        if not feed(chain, cameras, event.message):
            continue
        decision = next(told, None)
        if decision is None:
            raise ValueError(f"{decisions}: ends before the input at log time {event.log_utime} us")
        outcome.decisions += 1
        outcome.reasons[decision.reason] += 1
        pose = poses[chain.poses.newest.utime]
        start = in_force.start(pose)
        in_force.take(decision)
        if not decision.has_brake:
            continue
        outcome.verified += 1
        held = {link.view for link in chain.links}
        points = {view: cloud for view, cloud in points.items() if view in held}
        space = Space(settings, chain.steps(), chain.poses.newest.T_W_B, points)
        result = verify(decision, pose, start, space)
        if result.ambiguous:
            outcome.ambiguous += 1
            continue
        outcome.results.append(result)
        outcome.faults += [_describe(decision, fault, detail) for fault, detail in result.faults]
        if not result.faults:
            left = {name for name in PLANTED if name not in outcome.planted and tries[name] < TRIES}
            tries.update(left)
            outcome.planted |= plant(left, decision, result, pose, start, space)
    if next(told, None) is not None:
        raise ValueError(f"{decisions}: goes on behind the log's end")
    return outcome


def _describe(decision, fault, detail: str) -> str:
    speed = np.linalg.norm(decision.trajectory.velocity)
    return (f"decision {decision.sequence} at {decision.utime} us ({decision.reason}; candidate {decision.primitive}, "
            f"{speed:.2f} m/s): {fault}: {detail}")
