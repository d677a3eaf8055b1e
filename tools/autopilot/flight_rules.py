"""What PX4's OFFBOARD and ArduCopter's GUIDED demand of a companion, and what they do without it."""

from collections import deque

from pymavlink.dialects.v20 import common as mavlink


class Px4:
    """OFFBOARD is refused without a stream of setpoints, and left for HOLD when the stream ends (COM_OF_LOSS_T)."""

    AUTOPILOT = mavlink.MAV_AUTOPILOT_PX4
    EXTERNAL = "OFFBOARD"
    FAILSAFE = "HOLD"
    MODES = {"MANUAL": 1 << 16, "POSCTL": 3 << 16, "OFFBOARD": 6 << 16,
             "HOLD": 4 << 16 | 3 << 24, "RTL": 4 << 16 | 5 << 24, "LAND": 4 << 16 | 6 << 24}
    STREAM_S = 1.0  # of setpoints before OFFBOARD
    STREAM_HZ = 2.0

    def __init__(self, loss_s: float):
        self.loss_s = loss_s
        self._arrivals: deque[float] = deque(maxlen=1000)

    def setpoint(self, now: float) -> None:
        self._arrivals.append(now)

    def setpoint_age_s(self, now: float) -> float:
        return now - self._arrivals[-1] if self._arrivals else float("inf")

    def accepts_external(self, now: float) -> bool:
        recent = [arrival for arrival in self._arrivals if now - arrival <= self.STREAM_S]
        return len(recent) >= self.STREAM_HZ * self.STREAM_S and self.setpoint_age_s(now) <= 1.0 / self.STREAM_HZ

    def lost(self, now: float) -> bool:
        return self.setpoint_age_s(now) > self.loss_s

    @staticmethod
    def custom_mode_of(command) -> int:
        return int(command.param2) << 16 | int(command.param3) << 24


class ArduCopter:
    """GUIDED is always accepted; a velocity that is not sent again is flown for three seconds, then it stops there."""

    AUTOPILOT = mavlink.MAV_AUTOPILOT_ARDUPILOTMEGA
    EXTERNAL = "GUIDED"
    FAILSAFE = "GUIDED"
    MODES = {"STABILIZE": 0, "GUIDED": 4, "LOITER": 5, "RTL": 6, "LAND": 9, "BRAKE": 17}

    def __init__(self, loss_s: float):
        self.loss_s = loss_s
        self._arrival = float("-inf")

    def setpoint(self, now: float) -> None:
        self._arrival = now

    def setpoint_age_s(self, now: float) -> float:
        return now - self._arrival

    def accepts_external(self, now: float) -> bool:
        return True

    def lost(self, now: float) -> bool:
        return self.setpoint_age_s(now) > self.loss_s

    @staticmethod
    def custom_mode_of(command) -> int:
        return int(command.param2)


RULES = {"px4": (Px4, 1.0), "ardupilot": (ArduCopter, 3.0)}  # with their usual loss timeout in s
