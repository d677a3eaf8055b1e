"""A multicopter under a position controller, in LOCAL_NED, that does what setpoints ask for."""

import numpy as np
from multicopter import Multicopter, wrap

# PX4's cascade from position to acceleration: MPC_XY_P, MPC_Z_P, MPC_*_VEL_*_ACC.
POSITION_1_S = np.array([0.95, 0.95, 1.0])
VELOCITY_1_S = np.array([1.8, 1.8, 4.0])
INTEGRAL_1_S2 = np.array([0.4, 0.4, 2.0])
MAX_INTEGRAL_M_S2 = 4.0
MAX_HORIZONTAL_M_S, MAX_VERTICAL_M_S = 12.0, 3.0
STANDSTILL_M_S = 0.3  # below, a vehicle that was told to hold keeps to where it is

# POSITION_TARGET_TYPEMASK
IGNORE_POSITION = 1 << 0
IGNORE_VELOCITY = 1 << 3
IGNORE_ACCELERATION = 1 << 6
IGNORE_YAW = 1 << 10


class Vehicle:
    def __init__(self, altitude_m: float = 0.0, heading_rad: float = 0.0) -> None:
        self.body = Multicopter(altitude_m, heading_rad)
        self._integral = np.zeros(3)
        self._hold_at: np.ndarray | None = self.body.position.copy()  # None: still to come to a standstill
        self._hold_yaw_rad = heading_rad
        # What a correction of its own estimate adds to what it tells: north, east, down, heading.
        self.shift = np.zeros(3)
        self.turn_rad = 0.0

    def told_position(self) -> np.ndarray:
        return self.body.position + self.shift

    def stand(self) -> None:
        """Motors off."""
        self.body.stand()
        self._integral = np.zeros(3)

    def stop_here(self) -> None:
        """From now on, hold() comes to a standstill and stays there."""
        self._hold_at = None
        self._hold_yaw_rad = self.body.yaw_rad

    def take_off(self, altitude_m: float) -> None:
        """From now on, hold() goes straight up or down to this altitude."""
        self._hold_at = np.array([*self.body.position[:2], -altitude_m])

    def hold(self, dt_s: float) -> None:
        if self._hold_at is None and np.linalg.norm(self.body.velocity) < STANDSTILL_M_S:
            self._hold_at = self.body.position.copy()
        error = np.zeros(3) if self._hold_at is None else self._hold_at - self.body.position
        self._control(error, np.zeros(3), np.zeros(3), self._hold_yaw_rad, dt_s)

    def follow(self, target, dt_s: float) -> None:
        """`target` is a SET_POSITION_TARGET_LOCAL_NED."""
        mask = target.type_mask
        place = np.array([target.x, target.y, target.z]) - self.shift - self.body.position
        self._control(np.where(_ignored(mask, IGNORE_POSITION), 0.0, place),
                      np.where(_ignored(mask, IGNORE_VELOCITY), 0.0, (target.vx, target.vy, target.vz)),
                      np.where(_ignored(mask, IGNORE_ACCELERATION), 0.0, (target.afx, target.afy, target.afz)),
                      self.body.yaw_rad if mask & IGNORE_YAW else wrap(target.yaw - self.turn_rad), dt_s)

    def _control(self, place, velocity, acceleration, yaw_rad: float, dt_s: float) -> None:
        """`place` is how far away the wanted one is."""
        wanted = velocity + POSITION_1_S * place
        horizontal = np.linalg.norm(wanted[:2])
        if horizontal > MAX_HORIZONTAL_M_S:
            wanted[:2] *= MAX_HORIZONTAL_M_S / horizontal
        wanted[2] = np.clip(wanted[2], -MAX_VERTICAL_M_S, MAX_VERTICAL_M_S)
        error = wanted - self.body.velocity
        self._integral = np.clip(self._integral + dt_s * INTEGRAL_1_S2 * error, -MAX_INTEGRAL_M_S2, MAX_INTEGRAL_M_S2)
        self.body.step(acceleration + VELOCITY_1_S * error + self._integral, yaw_rad, dt_s)


def _ignored(mask: int, first: int) -> np.ndarray:
    """By axis."""
    return np.array([bool(mask & (first << axis)) for axis in range(3)])
