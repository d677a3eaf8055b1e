"""A point mass with a heading, in LOCAL_NED, that does what setpoints ask for."""

import math

MAX_SPEED_M_S = 5.0
MAX_ACCELERATION_M_S2 = 6.0
MAX_YAW_RATE_RAD_S = 1.5
POSITION_GAIN_PER_S = 1.2
VELOCITY_GAIN_PER_S = 4.0
YAW_GAIN_PER_S = 3.0
GROUND_M = 0.05  # nearer than this it stands on the ground

# POSITION_TARGET_TYPEMASK
IGNORE_POSITION = 1 << 0
IGNORE_VELOCITY = 1 << 3
IGNORE_ACCELERATION = 1 << 6
IGNORE_YAW = 1 << 10


def clamp(value: float, limit: float) -> float:
    return max(-limit, min(limit, value))


def wrap(angle_rad: float) -> float:
    return math.remainder(angle_rad, 2 * math.pi)


class Vehicle:
    def __init__(self) -> None:
        self.position = [0.0, 0.0, 0.0]  # north, east, down, in m
        self.velocity = [0.0, 0.0, 0.0]
        self.yaw_rad = 0.0
        # What a correction of its own estimate adds to what it tells: north, east, down, heading.
        self.shift = [0.0, 0.0, 0.0]
        self.turn_rad = 0.0

    @property
    def landed(self) -> bool:
        return self.position[2] > -GROUND_M

    def told_position(self) -> list[float]:
        return [position + shift for position, shift in zip(self.position, self.shift)]

    def told_yaw_rad(self) -> float:
        return wrap(self.yaw_rad + self.turn_rad)

    def hold(self, at: list[float], dt_s: float) -> None:
        self._accelerate([POSITION_GAIN_PER_S * (a - p) for a, p in zip(at, self.position)], [0.0] * 3, dt_s)

    def follow(self, target, dt_s: float) -> None:
        """`target` is a SET_POSITION_TARGET_LOCAL_NED."""
        wanted = [0.0, 0.0, 0.0]
        ahead = [0.0, 0.0, 0.0]
        places = (target.x, target.y, target.z)
        velocities = (target.vx, target.vy, target.vz)
        accelerations = (target.afx, target.afy, target.afz)
        for axis in range(3):
            if not target.type_mask & (IGNORE_POSITION << axis):
                wanted[axis] += POSITION_GAIN_PER_S * (places[axis] - self.shift[axis] - self.position[axis])
            if not target.type_mask & (IGNORE_VELOCITY << axis):
                wanted[axis] += velocities[axis]
            if not target.type_mask & (IGNORE_ACCELERATION << axis):
                ahead[axis] = accelerations[axis]
        self._accelerate(wanted, ahead, dt_s)
        if not target.type_mask & IGNORE_YAW:
            rate = YAW_GAIN_PER_S * wrap(target.yaw - self.turn_rad - self.yaw_rad)
            self.yaw_rad = wrap(self.yaw_rad + clamp(rate, MAX_YAW_RATE_RAD_S) * dt_s)

    def stand(self) -> None:
        self.velocity = [0.0, 0.0, 0.0]

    def _accelerate(self, wanted: list[float], ahead: list[float], dt_s: float) -> None:
        for axis in range(3):
            error = clamp(wanted[axis], MAX_SPEED_M_S) - self.velocity[axis]
            acceleration = clamp(VELOCITY_GAIN_PER_S * error + ahead[axis], MAX_ACCELERATION_M_S2)
            self.velocity[axis] += acceleration * dt_s
            self.position[axis] += self.velocity[axis] * dt_s
        if self.position[2] > 0.0:
            self.position[2] = 0.0
            self.velocity[2] = min(0.0, self.velocity[2])
