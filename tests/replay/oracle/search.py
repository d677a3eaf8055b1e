"""Algorithm 1 of the paper for many points at once, one step of the chain after the other."""

from dataclasses import dataclass

import numpy as np
from chain import Step
from nanomap_log import Status

CONTAINED = (Status.FREE, Status.OPEN)
ROUNDING_M = 1e-9


@dataclass
class Found:
    """One row a point; `view` is the index of the step that answers, -1 without any view."""

    status: np.ndarray
    view: np.ndarray
    mean: np.ndarray
    covariance: np.ndarray
    ambiguous: np.ndarray  # a status on the way was decided within rounding


def search(steps: list[Step], mean_B: np.ndarray, covariance_B: np.ndarray, up_B: np.ndarray,
           around_m: float = 0.0) -> Found:
    """`up_B` points against gravity, in B; `around_m` as of View.classify."""
    count = len(mean_B)
    found = Found(np.full(count, Status.EMPTY), np.full(count, -1), mean_B.copy(), covariance_B.copy(),
                  np.zeros(count, dtype=bool))
    mean, covariance, up = mean_B, covariance_B, up_B
    pending = np.arange(count)
    for i, step in enumerate(steps):
        R, t = step.T_C_newer[:3, :3], step.T_C_newer[:3, 3]
        mean = mean @ R.T + t
        covariance = step.covariance + R @ covariance @ R.T
        up = R @ up
        verdicts = step.view.classify(mean, covariance, up, around_m)
        found.ambiguous[pending] |= verdicts.margin < 1
        contained = np.isin(verdicts.status, CONTAINED)
        settled = contained | (i == 0)  # the newest view's own status stands until another view contains the point
        rows = pending[settled]
        found.status[rows], found.view[rows] = verdicts.status[settled], i
        found.mean[rows], found.covariance[rows] = mean[settled], covariance[settled]
        pending, mean, covariance = pending[~contained], mean[~contained], covariance[~contained]
        if len(pending) == 0:
            break
    return found


def newest_holding(steps: list[Step], mean_B: np.ndarray, covariance_B: np.ndarray, answered: Found) -> Found:
    """The newest view whose frustum holds the mean, of those newer than the one that answered `search`. Marks points of
    `answered` ambiguous where that hangs on rounding. `status` is EMPTY, and means nothing."""
    found = Found(np.full(len(mean_B), Status.EMPTY), np.full(len(mean_B), -1), mean_B.copy(), covariance_B.copy(),
                  answered.ambiguous)
    mean, covariance = mean_B, covariance_B
    pending = np.arange(len(mean_B))
    for i, step in enumerate(steps):
        wanted = i < answered.view[pending]
        pending, mean, covariance = pending[wanted], mean[wanted], covariance[wanted]
        if len(pending) == 0:
            break
        R, t = step.T_C_newer[:3, :3], step.T_C_newer[:3, 3]
        mean = mean @ R.T + t
        covariance = step.covariance + R @ covariance @ R.T
        inside_m = step.view.inside_by(mean, np.zeros_like(covariance), 0.0)
        found.ambiguous[pending] |= np.abs(inside_m) < ROUNDING_M
        holds = inside_m >= 0
        rows = pending[holds]
        found.view[rows], found.mean[rows], found.covariance[rows] = i, mean[holds], covariance[holds]
        pending, mean, covariance = pending[~holds], mean[~holds], covariance[~holds]
    return found


def nearest_distances(points: np.ndarray, mean: np.ndarray, count: int) -> np.ndarray:
    """The `count` smallest distances [m] from `mean` to the points, ascending; all of them if there are fewer."""
    squared = np.sum((points - mean) ** 2, axis=1)
    count = min(count, len(squared))
    if count == 0:
        return np.empty(0)
    return np.sqrt(np.sort(np.partition(squared, count - 1)[:count]))
