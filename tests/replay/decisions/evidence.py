"""What the views know about moments of a motion: searched and measured by brute force, without core or planner."""

import itertools
import math
from dataclasses import dataclass

import numpy as np
from chain import Step
from motion import Motion, States
from nanomap_log import Status
from planner_settings import PlannerSettings
from search import CONTAINED, Found, newest_holding, search
from tail import NEGLIGIBLE_SIGMAS, tail

STRETCHES = 5
STANDING_M_S = 1e-6
RETURN_DEVIATION = 0.25  # planner/aside.h


@dataclass(frozen=True)
class Evidence:
    """One row a moment."""

    elapsed: np.ndarray  # s
    position_W: np.ndarray  # m
    status: np.ndarray
    ambiguous: np.ndarray  # a status on the way was decided within rounding
    in_bubble: np.ndarray
    nearest: np.ndarray  # m, measured point of the views that are asked; infinite if none is near enough to matter
    risk: np.ndarray

    @property
    def seen_free(self) -> np.ndarray:
        return self.in_bubble | np.isin(self.status, CONTAINED)

    def whole_risk(self) -> float:
        return float(1 - np.prod(1 - self.risk))


class Space:
    """What is known at one decision. `points` keeps the views' measured points from decision to decision."""

    def __init__(self, settings: PlannerSettings, steps: list[Step], T_W_B: np.ndarray, points: dict):
        self.settings, self.steps, self.T_W_B, self._points = settings, steps, T_W_B, points

    def on(self, motion: Motion, elapsed: np.ndarray, reach_m: float = 0.0) -> Evidence:
        """Measured points up to `reach_m` from the vehicle's surface are found, and all that risk needs."""
        settings = self.settings
        states = motion.at(elapsed)
        R_W_B, t_W_B = self.T_W_B[:3, :3], self.T_W_B[:3, 3]
        mean_W = states.position + self._aside_W(motion, elapsed)
        mean_B = (mean_W - t_W_B) @ R_W_B
        covariance_B, up_B = self._covariance_B(motion, states, elapsed), R_W_B.T @ [0, 0, 1]
        found = search(self.steps, mean_B, covariance_B, up_B)
        nearest, collision = self._near(found, reach_m)
        if settings.look_beside:
            newer = newest_holding(self.steps, mean_B, covariance_B, found)
            newer_nearest, newer_collision = self._near(newer, reach_m)
            nearest = np.minimum(nearest, newer_nearest)
            collision = np.maximum(collision, newer_collision)
            rows = np.flatnonzero(self._is_cramped(found))
            beside = search(self.steps, mean_B[rows], covariance_B[rows], up_B, settings.radius_m)
            with_room = np.isin(beside.status, CONTAINED)
            beside_nearest, beside_collision = self._near(beside, reach_m)
            nearest[rows] = np.where(with_room, np.minimum(nearest[rows], beside_nearest), nearest[rows])
            unseen = np.linalg.norm(mean_B[rows], axis=1) > settings.beside_beyond_m
            collision[rows] = np.maximum(collision[rows], np.where(with_room, beside_collision, unseen))
            found.ambiguous[rows] |= beside.ambiguous
        in_bubble = np.linalg.norm(mean_B, axis=1) <= settings.bubble_m
        prior = np.where(in_bubble, 0.0, settings.prior[found.status])
        return Evidence(elapsed, mean_W, found.status, found.ambiguous, in_bubble, nearest,
                        1 - (1 - prior) * (1 - collision))

    def _aside_W(self, motion: Motion, elapsed: np.ndarray) -> np.ndarray:
        """From the motion to where the vehicle is expected: it comes back evenly from where it is at the start."""
        return self._left(elapsed)[:, None] * self._aside_at_start_W(motion)

    def _aside_at_start_W(self, motion: Motion) -> np.ndarray:
        return self.T_W_B[:3, 3] - motion.at(np.zeros(1)).position[0]

    def _left(self, elapsed: np.ndarray) -> np.ndarray:
        recovery_s = self.settings.recovery_s
        return np.clip(1 - elapsed / recovery_s, 0, None) if recovery_s > 0 else np.zeros(len(elapsed))

    def on_samples(self, motion: Motion, steps: int) -> Evidence:
        """At the planner's moments (planner/stretches.h), and on until a vehicle that stands is back."""
        radius_m = self.settings.radius_m
        times = sample_times(motion, steps, radius_m)
        end = np.array([motion.duration])
        aside_m = float(np.linalg.norm(self._aside_W(motion, end)))
        if aside_m > 0 and np.linalg.norm(motion.at(end).velocity) <= STANDING_M_S:
            parts = max(1, math.ceil(aside_m / radius_m))
            times = np.concatenate([times, np.linspace(motion.duration, self.settings.recovery_s, parts + 1)[1:]])
        return self.on(motion, times)

    def _near(self, found: Found, reach_m: float) -> tuple[np.ndarray, np.ndarray]:
        """Distance to the nearest point that the answering views have measured, and the chance to touch it."""
        radius_m = self.settings.radius_m
        nearest = np.full(len(found.view), np.inf)
        for view in set(found.view.tolist()) - {-1}:
            rows = np.flatnonzero(found.view == view)
            sigma = np.sqrt(np.linalg.eigvalsh(found.covariance[rows]).max())
            reach = radius_m + max(reach_m, NEGLIGIBLE_SIGMAS * sigma)
            nearest[rows] = _nearest(self._points_of(view), found.mean[rows], reach)
        collision = np.array([tail(covariance, d - radius_m) if np.isfinite(d) else 0.0
                              for covariance, d in zip(found.covariance, nearest)])
        return nearest, collision

    def _is_cramped(self, found: Found) -> np.ndarray:
        """Seen, but by a view without room for the vehicle around the place."""
        cramped = np.zeros(len(found.view), dtype=bool)
        for view in set(found.view[np.isin(found.status, CONTAINED)].tolist()):
            rows = np.flatnonzero(np.isin(found.status, CONTAINED) & (found.view == view))
            inside = self.steps[view].view.inside_by(found.mean[rows], found.covariance[rows], self.settings.radius_m)
            cramped[rows] = inside < 0
        return cramped

    def _covariance_B(self, motion: Motion, states: States, elapsed: np.ndarray) -> np.ndarray:
        speed = np.linalg.norm(states.velocity, axis=1)
        horizontal, vertical = (growth.at(speed, elapsed) for growth in (self.settings.horizontal,
                                                                        self.settings.vertical))
        variances_W = np.column_stack([horizontal, horizontal, vertical])**2
        R_B_W = self.T_W_B[:3, :3].T
        back_W = RETURN_DEVIATION * (1 - self._left(elapsed))[:, None] * self._aside_at_start_W(motion)
        back_B = back_W @ R_B_W.T if self.settings.recovery_s > 0 else np.zeros((len(elapsed), 3))
        return (np.einsum("ij,nj,kj->nik", R_B_W, variances_W, R_B_W) + np.einsum("ni,nj->nij", back_B, back_B))

    def _points_of(self, view: int) -> np.ndarray:
        key = self.steps[view].view
        if key not in self._points:
            self._points[key] = key.points()
        return self._points[key]

    def is_hidden(self, position_W: np.ndarray, status: Status) -> bool:
        """Whether a place, known exactly and outside the bubble, has that status."""
        mean_B = self.T_W_B[:3, :3].T @ (position_W - self.T_W_B[:3, 3])
        found = search(self.steps, mean_B[None], np.zeros((1, 3, 3)), self.T_W_B[2, :3])
        return bool(found.status[0] == status and np.linalg.norm(mean_B) > self.settings.bubble_m)


def sample_times(motion: Motion, least: int, longest_m: float) -> np.ndarray:
    """The ends of five stretches of equal time, even steps along each, `least` in all or more, and parts of those that
    are longer than `longest_m`."""
    stretches = min(least, STRETCHES)
    times = [np.zeros(1)]
    for begin, end in itertools.pairwise(motion.duration * np.arange(stretches + 1) / stretches):
        at = motion.at(np.array([begin, end]))
        length = max(np.linalg.norm(at.position[1] - at.position[0]),
                     np.linalg.norm(at.velocity, axis=1).max() * motion.duration / stretches)
        steps = max(math.ceil(length / longest_m), math.ceil(least / stretches))
        ends = np.linspace(begin, end, steps + 1)
        apart = np.linalg.norm(np.diff(motion.at(ends).position, axis=0), axis=1)
        for i, parts in enumerate(np.maximum(np.ceil(apart / longest_m).astype(int), 1)):
            times.append(np.linspace(ends[i], ends[i + 1], parts + 1)[1:])
    return np.concatenate(times)


def _nearest(points: np.ndarray, means: np.ndarray, reach: float) -> np.ndarray:
    """Distance [m] of each mean to the nearest point; infinite beyond `reach`."""
    inside = np.all((points > means.min(axis=0) - reach) & (points < means.max(axis=0) + reach), axis=1)
    close = points[inside]
    if len(close) == 0:
        return np.full(len(means), np.inf)
    nearest = np.sqrt([np.sum((close - mean)**2, axis=1).min() for mean in means])
    return np.where(nearest <= reach, nearest, np.inf)
