"""Answers of the module against the oracle's, number by number."""

from dataclasses import dataclass, field

import numpy as np
from chain import Chain, Step
from nanomap_log import Status, matrix
from search import CONTAINED, nearest_distances, search

RELATIVE = 1e-9  # double precision, after some hundred products
SINGLE_RELATIVE = 2e-6  # points are kept in single precision
SINGLE_ABSOLUTE_M = 1e-5  # and so is the difference of coordinates of up to some tens of metres


@dataclass
class Tally:
    """What was compared. `mismatches` holds one text each, with all numbers."""

    answers: int = 0
    messages: int = 0
    ambiguous: int = 0
    statuses: dict = field(default_factory=dict)
    deepest_view: int = 0
    mismatches: list[str] = field(default_factory=list)


@dataclass(frozen=True)
class Right:
    """What one answer should say; `view` -1 without any."""

    status: Status
    view: int
    mean: np.ndarray
    covariance: np.ndarray


def close(a, b, scale: float) -> bool:
    return bool(np.all(np.abs(np.asarray(a) - np.asarray(b)) <= RELATIVE * scale))


def compare(message, chain: Chain, tally: Tally, stride: int) -> None:
    """One nanomap.answers_t against the chain at that moment; every `stride`-th answer, from a moving start."""
    steps = chain.steps()
    _compare_heading(message, chain, len(steps), tally)
    answers = message.answers[tally.messages % stride::stride]
    tally.messages += 1
    if not answers:
        return
    mean_B = np.array([answer.mean_body for answer in answers])
    covariance_B = np.array([answer.covariance_body for answer in answers]).reshape(-1, 3, 3)
    up_B = matrix(message.world_from_body)[2, :3]  # the z axis of W, in B
    found = search(steps, mean_B, covariance_B, up_B)
    points = {view: steps[view].view.points() for view in set(found.view.tolist()) if view >= 0}
    for i, answer in enumerate(answers):
        tally.answers += 1
        status, view = Status(found.status[i]), int(found.view[i])
        right = Right(status, view, found.mean[i], found.covariance[i])
        faults = _faults(answer, right, steps, points.get(view), chain.settings.neighbours)
        if faults and found.ambiguous[i] and (answer.status, answer.view_index) != (status, view):
            tally.ambiguous += 1
            continue
        tally.statuses[status.name] = tally.statuses.get(status.name, 0) + 1
        if status in CONTAINED:
            tally.deepest_view = max(tally.deepest_view, view)
        if faults:
            tally.mismatches.append(_describe(message, answer, right, faults))


def _compare_heading(message, chain: Chain, views: int, tally: Tally) -> None:
    pose = chain.poses.newest
    told = (message.utime, message.pose_sequence, message.epoch, message.num_views)
    right = (pose.utime, pose.sequence, pose.epoch, views)
    T_W_B = matrix(message.world_from_body)
    if told != right or not close(T_W_B, pose.T_W_B, 1 + np.abs(pose.T_W_B).max()):
        tally.mismatches.append(f"answers at {message.utime} us: stamp, pose, epoch, views are {told}, not {right}; "
                                f"T_W_B\n{T_W_B}\nnot\n{pose.T_W_B}")


def _faults(answer, right: Right, steps: list[Step], points: np.ndarray | None, neighbours: int) -> list[str]:
    faults = []
    if answer.status != right.status:
        faults.append("status")
    if bool(answer.has_view) != (right.view >= 0):
        faults.append("has_view")
    if right.view < 0 or not answer.has_view:
        return faults + (["neighbours without a view"] if answer.num_neighbours else [])
    view = steps[right.view].view
    if (answer.view_index, answer.view_sequence, answer.view_utime) != (right.view, view.sequence, view.utime):
        return [*faults, "view"]
    if not close(answer.mean_camera, right.mean, 1 + np.abs(right.mean).max()):
        faults.append("mean")
    if not close(answer.covariance_camera, right.covariance.ravel(), np.abs(right.covariance).max()):
        faults.append("covariance")
    return faults + _neighbour_faults(answer, nearest_distances(points, right.mean, neighbours), right.mean)


def _neighbour_faults(answer, distances_m: np.ndarray, mean: np.ndarray) -> list[str]:
    told = np.array(answer.distances)
    if len(told) != len(distances_m):
        return [f"{len(told)} neighbours instead of {len(distances_m)}"]
    faults = []
    tolerance = SINGLE_ABSOLUTE_M + SINGLE_RELATIVE * distances_m
    if np.any(np.abs(told - distances_m) > tolerance):
        faults.append(f"distances, which are {distances_m.tolist()}")
    own = np.linalg.norm(np.array(answer.neighbours).reshape(-1, 3) - mean, axis=1)
    if np.any(np.abs(told - own) > tolerance):
        faults.append("neighbours that are not at their distances")
    return faults


def _describe(message, answer, right: Right, faults: list[str]) -> str:
    return (f"at {message.utime} us, wrong: {', '.join(faults)}\n"
            f"  asked   mean_B {answer.mean_body} covariance_B {answer.covariance_body}\n"
            f"  told    {Status(answer.status).name} view {answer.view_index} (sequence {answer.view_sequence}, "
            f"{answer.view_utime} us) mean_C {answer.mean_camera} covariance_C {answer.covariance_camera} "
            f"distances {answer.distances} neighbours {answer.neighbours}\n"
            f"  oracle  {right.status.name} view {right.view} mean_C {right.mean.tolist()} "
            f"covariance_C {right.covariance.ravel().tolist()}")
