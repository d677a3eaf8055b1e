"""Streams what an autopilot tells, each message at its own interval."""

from collections.abc import Callable

from multicopter import quaternion, turned
from pymavlink.dialects.v20 import common as mavlink

HEARTBEAT = mavlink.MAVLINK_MSG_ID_HEARTBEAT
ATTITUDE = mavlink.MAVLINK_MSG_ID_ATTITUDE_QUATERNION
POSITION = mavlink.MAVLINK_MSG_ID_LOCAL_POSITION_NED
LANDED = mavlink.MAVLINK_MSG_ID_EXTENDED_SYS_STATE
TIMESYNC = mavlink.MAVLINK_MSG_ID_TIMESYNC

# PX4 streams to a companion by itself; ArduPilot waits to be asked.
UNASKED_INTERVAL_S = {
    "px4": {HEARTBEAT: 1.0, TIMESYNC: 1.0, ATTITUDE: 0.1, POSITION: 0.1, LANDED: 1.0},
    "ardupilot": {HEARTBEAT: 1.0, TIMESYNC: 1.0},
}


class Telemetry:
    def __init__(self, link: mavlink.MAVLink, rules_name: str, true: bool):
        """`true`: where the vehicle is, not where its estimator believes that it is."""
        self._link = link
        self._true = true
        self._interval_s = dict(UNASKED_INTERVAL_S[rules_name])
        self._due: dict[int, float] = {}
        self._senders: dict[int, Callable] = {HEARTBEAT: self._heartbeat, TIMESYNC: self._timesync,
                                              ATTITUDE: self._attitude, POSITION: self._position,
                                              LANDED: self._landed}

    def set_interval(self, message_id: int, interval_s: float) -> bool:
        """False for a message that is not to be had."""
        if message_id not in self._senders or interval_s <= 0.0:
            return False
        self._interval_s[message_id] = interval_s
        return True

    def send_now(self, message_id: int) -> None:
        self._due.pop(message_id, None)

    def send_due(self, now: float, autopilot) -> None:
        for message_id, interval_s in self._interval_s.items():
            if now < self._due.get(message_id, now):
                continue
            self._due[message_id] = max(self._due.get(message_id, now) + interval_s, now)
            self._senders[message_id](now, autopilot)

    def _heartbeat(self, now: float, autopilot) -> None:
        base_mode = mavlink.MAV_MODE_FLAG_CUSTOM_MODE_ENABLED | mavlink.MAV_MODE_FLAG_HIL_ENABLED
        if autopilot.armed:
            base_mode |= mavlink.MAV_MODE_FLAG_SAFETY_ARMED
        status = mavlink.MAV_STATE_ACTIVE if autopilot.armed else mavlink.MAV_STATE_STANDBY
        self._link.heartbeat_send(mavlink.MAV_TYPE_QUADROTOR, autopilot.rules.AUTOPILOT, base_mode,
                                  autopilot.rules.MODES[autopilot.mode], status)

    def _timesync(self, now: float, autopilot) -> None:
        self._link.timesync_send(0, int(now * 1e9))

    def _attitude(self, now: float, autopilot) -> None:
        vehicle = autopilot.vehicle
        rotation = vehicle.body.axes() if self._true else turned(vehicle.body.axes(), vehicle.turn_rad)
        self._link.attitude_quaternion_send(autopilot.boot_ms(), *quaternion(rotation), *vehicle.body.rates)

    def _position(self, now: float, autopilot) -> None:
        vehicle = autopilot.vehicle
        position = vehicle.body.position if self._true else vehicle.told_position()
        self._link.local_position_ned_send(autopilot.boot_ms(), *position, *vehicle.body.velocity)

    def _landed(self, now: float, autopilot) -> None:
        landed = autopilot.vehicle.body.landed
        state = mavlink.MAV_LANDED_STATE_ON_GROUND if landed else mavlink.MAV_LANDED_STATE_IN_AIR
        self._link.extended_sys_state_send(mavlink.MAV_VTOL_STATE_UNDEFINED, state)
