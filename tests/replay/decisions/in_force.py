"""Where a plan starts: on the motion in force if the vehicle follows it, else at its pose
(planner/receding_horizon.h)."""

from dataclasses import dataclass

import numpy as np
from motion import Motion
from planner_settings import PlannerSettings

NOTHING_VERIFIED = "nothing is safe, not even stopping: keep to the last verified brake"


@dataclass(frozen=True)
class Start:
    """In W [m, m/s, m/s^2]; what is not finite is not known. On the motion in force if there is one."""

    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray
    in_force: Motion | None = None
    passed_s: float = 0.0  # of the motion in force


class InForce:
    def __init__(self, settings: PlannerSettings):
        self._settings = settings
        self._motion: Motion | None = None
        self._epoch = 0

    def take(self, decision) -> None:
        if decision.has_motion and decision.reason != NOTHING_VERIFIED:
            self._motion, self._epoch = Motion(decision.brake), decision.epoch

    def start(self, pose) -> Start:
        measured = Start(*(np.array(v) for v in (pose.world_from_body.translation, pose.velocity, pose.acceleration)))
        if self._motion is None or self._epoch != pose.epoch:
            return measured
        passed_s = (pose.utime - self._motion.utime) / 1e6
        told = self._motion.at(np.array([passed_s]))
        follows = (np.linalg.norm(measured.position - told.position[0]) <= self._settings.max_position_error_m
                   and np.linalg.norm(measured.velocity - told.velocity[0]) <= self._settings.max_velocity_error_m_s)
        if not follows:
            return measured
        return Start(told.position[0], told.velocity[0], told.acceleration[0], self._motion, passed_s)
