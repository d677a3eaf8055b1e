"""Motion of a multicopter in LOCAL_NED with limited tilt and thrust, lags and drag.

The numbers are those of tools/simulation/multicopter.h.
"""

import math

import numpy as np

GRAVITY_M_S2 = np.array([0.0, 0.0, 9.80665])
DOWN = np.array([0.0, 0.0, 1.0])
ATTITUDE_TIME_CONSTANT_S = 0.08
THRUST_TIME_CONSTANT_S = 0.04
YAW_TIME_CONSTANT_S = 0.25
MAX_TILT_RAD = 0.698  # 40 degrees
MAX_YAW_RATE_RAD_S = 1.5
MIN_THRUST_M_S2 = 1.0
MAX_THRUST_M_S2 = 20.0
DRAG_1_S = 0.1
GROUND_M = 0.05  # nearer than this it stands on the ground


def wrap(angle_rad: float) -> float:
    return math.remainder(angle_rad, 2 * math.pi)


class Multicopter:
    def __init__(self, altitude_m: float, heading_rad: float):
        self.position = np.array([0.0, 0.0, -altitude_m])  # north, east, down, in m
        self.velocity = np.zeros(3)
        self.yaw_rad = heading_rad
        self.rates = np.zeros(3)  # of the body, forward, right, down, in rad/s
        self._up = -DOWN  # the direction of the thrust
        self._thrust = GRAVITY_M_S2[2]  # per mass

    @property
    def landed(self) -> bool:
        return self.position[2] > -GROUND_M

    def axes(self) -> np.ndarray:
        """R_NED_FRD, whose columns are the body's axes."""
        return axes(self._up, self.yaw_rad)

    def stand(self) -> None:
        """Motors off: it stays where it is."""
        self.velocity = np.zeros(3)
        self.rates = np.zeros(3)
        self._up = -DOWN

    def step(self, acceleration: np.ndarray, yaw_rad: float, dt_s: float) -> None:
        """Strives for the acceleration, gravity removed, and for the heading."""
        before = self.axes()
        wanted = _allowed_thrust(acceleration)
        size = np.linalg.norm(wanted)
        self._up = self._up + _share(dt_s, ATTITUDE_TIME_CONSTANT_S) * (wanted / size - self._up)
        self._up /= np.linalg.norm(self._up)
        self._thrust += _share(dt_s, THRUST_TIME_CONSTANT_S) * (size - self._thrust)
        turn = wrap(yaw_rad - self.yaw_rad) * _share(dt_s, YAW_TIME_CONSTANT_S)
        self.yaw_rad = wrap(self.yaw_rad + max(-MAX_YAW_RATE_RAD_S * dt_s, min(MAX_YAW_RATE_RAD_S * dt_s, turn)))

        acceleration = self._thrust * self._up + GRAVITY_M_S2 - DRAG_1_S * self.velocity
        self.position = self.position + (self.velocity + acceleration * dt_s / 2) * dt_s
        self.velocity = self.velocity + acceleration * dt_s
        if self.position[2] > 0.0:
            self.position[2] = 0.0
            self.velocity = np.array([0.0, 0.0, min(0.0, self.velocity[2])])
        self.rates = _rotation_vector(before.T @ self.axes()) / dt_s


def axes(up: np.ndarray, yaw_rad: float) -> np.ndarray:
    """R_NED_FRD of a vehicle whose thrust points `up`, and whose forward axis lies in the direction of its heading."""
    right_level = np.array([-math.sin(yaw_rad), math.cos(yaw_rad), 0.0])
    forward = np.cross(right_level, -up)
    forward /= np.linalg.norm(forward)
    return np.column_stack([forward, np.cross(-up, forward), -up])


def _share(dt_s: float, time_constant_s: float) -> float:
    return 1.0 - math.exp(-dt_s / time_constant_s)


def _allowed_thrust(acceleration: np.ndarray) -> np.ndarray:
    """Height comes first: what the amount does not allow is taken from the horizontal part."""
    thrust = acceleration - GRAVITY_M_S2
    thrust[2] = -min(max(-thrust[2], MIN_THRUST_M_S2), MAX_THRUST_M_S2)
    most = min(-thrust[2] * math.tan(MAX_TILT_RAD), math.sqrt(MAX_THRUST_M_S2**2 - thrust[2] ** 2))
    horizontal = math.hypot(thrust[0], thrust[1])
    if horizontal > most:
        thrust[:2] *= most / horizontal
    return thrust


def _rotation_vector(rotation: np.ndarray) -> np.ndarray:
    """Of a small turn."""
    return np.array([rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                     rotation[1, 0] - rotation[0, 1]]) / 2


def quaternion(rotation: np.ndarray) -> tuple[float, float, float, float]:
    """w, x, y, z. The body's z axis must not point up: a vehicle that is tilted by less than 90 degrees."""
    w = math.sqrt(max(0.0, 1.0 + np.trace(rotation))) / 2
    if w > 0.1:
        x, y, z = (rotation[2, 1] - rotation[1, 2], rotation[0, 2] - rotation[2, 0],
                   rotation[1, 0] - rotation[0, 1])
        return w, x / (4 * w), y / (4 * w), z / (4 * w)
    # Heading south: z is the largest.
    z = math.sqrt(max(0.0, 1.0 - rotation[0, 0] - rotation[1, 1] + rotation[2, 2])) / 2
    return ((rotation[1, 0] - rotation[0, 1]) / (4 * z), (rotation[0, 2] + rotation[2, 0]) / (4 * z),
            (rotation[1, 2] + rotation[2, 1]) / (4 * z), z)


def turned(rotation: np.ndarray, angle_rad: float) -> np.ndarray:
    """About the vertical, clockwise as seen from above."""
    cosine, sine = math.cos(angle_rad), math.sin(angle_rad)
    return np.array([[cosine, -sine, 0.0], [sine, cosine, 0.0], [0.0, 0.0, 1.0]]) @ rotation
