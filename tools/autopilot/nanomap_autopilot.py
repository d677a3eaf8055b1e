"""An autopilot to test a companion against: a multicopter under PX4's OFFBOARD or ArduCopter's GUIDED rules.

What it receives and decides it prints, one JSON object a line, beginning with its URL. Its pilot sits at the standard
input; the program ends with it:
  mode NAME            switch the mode; PX4 refuses OFFBOARD without a stream of setpoints
  arm | disarm
  takeoff ALTITUDE     go straight up to so many m above the ground and hold there; it must be armed
  telemetry on | off   "off" is a link that has gone dead
  shift N E D YAW      its estimate is corrected by so many m and rad
  state                print where the vehicle is
"""

import argparse
import contextlib
import json
import math
import os
import select
import sys
import time

import numpy as np
import telemetry as streams
from flight_rules import RULES
from parameters import Parameters
from pymavlink.dialects.v20 import common as mavlink
from transport import Serial, Tcp, Udp
from vehicle import Vehicle

STEP_S = 0.005
TOLD = {"HEARTBEAT", "SET_POSITION_TARGET_LOCAL_NED", "OBSTACLE_DISTANCE", "ODOMETRY", "STATUSTEXT", "TIMESYNC"}


def tell(event: str, **details) -> None:
    print(json.dumps({"event": event, "time_s": time.monotonic(), **details}), flush=True)


def plain(value):
    """As JSON has it, which knows no NaN."""
    if isinstance(value, list):
        return [plain(element) for element in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value


class Endpoint:
    """One who is told and listened to."""

    def __init__(self, transport, system: int, rules_name: str, true: bool):
        self.transport = transport
        self.link = mavlink.MAVLink(transport, srcSystem=system, srcComponent=mavlink.MAV_COMP_ID_AUTOPILOT1)
        self.telemetry = streams.Telemetry(self.link, rules_name, true)
        self._parser = mavlink.MAVLink(None)
        self._parser.robust_parsing = True

    def fileno(self) -> int:
        return self.transport.fileno()

    def messages(self) -> list:
        return self._parser.parse_buffer(self.transport.read()) or []


class Autopilot:
    def __init__(self, rules_name: str, loss_s: float | None, vehicle: Vehicle, transport, truth_transport=None,
                 parameters: dict[str, float] | None = None, system: int = 1):
        """`truth_transport` leads to who is told where the vehicle really is; it commands nothing. `parameters` are
        told as given, but not obeyed."""
        rules, usual_loss_s = RULES[rules_name]
        self.rules = rules(usual_loss_s if loss_s is None else loss_s)
        self.parameters = Parameters(rules_name, self.rules.loss_s, parameters or {})
        self.vehicle = vehicle
        self.mode = next(iter(self.rules.MODES))
        self.armed = not vehicle.body.landed
        self._start = time.monotonic()
        self._target = None
        self._telemetry_on = True
        self._companion = Endpoint(transport, system, rules_name, true=False)
        self._endpoints = [self._companion]
        if truth_transport:
            self._endpoints.append(Endpoint(truth_transport, system, rules_name, true=True))
        self._stepped = self._start

    def boot_ms(self) -> int:
        """Of the moment that the vehicle's motion has been computed for."""
        return round((self._stepped - self._start) * 1000)

    def run(self) -> None:
        tell("ready", url=self._companion.transport.url, boot_s=self._start)
        pilot = PilotLines()
        while not pilot.gone:
            due_s = max(0.0, self._stepped + STEP_S - time.monotonic())
            readable, _, _ = select.select([*self._endpoints, pilot], [], [], due_s)
            for endpoint in self._endpoints:
                if endpoint in readable:
                    for message in endpoint.messages():
                        self._receive(message, endpoint)
            if pilot in readable:
                for line in pilot.lines():
                    self._obey(line.split())
            now = time.monotonic()
            self._step(now)
            for endpoint in self._endpoints:
                if self._telemetry_on or endpoint is not self._companion:
                    endpoint.telemetry.send_due(now, self)

    def _switch(self, mode: str, why: str) -> bool:
        now = time.monotonic()
        if mode not in self.rules.MODES or (mode == self.rules.EXTERNAL and not self.rules.accepts_external(now)):
            tell("refused", mode=mode)
            return False
        self.mode = mode
        self.vehicle.stop_here()
        self._announce()
        tell("mode", mode=mode, why=why)
        return True

    def _announce(self) -> None:
        for endpoint in self._endpoints:
            endpoint.telemetry.send_now(streams.HEARTBEAT)

    def _obey(self, words: list[str]) -> None:
        match words:
            case ["mode", mode]:
                self._switch(mode, "pilot")
            case ["arm" | "disarm" as order]:
                self.armed = order == "arm"
                self._announce()
            case ["takeoff", altitude] if self.armed:
                self.vehicle.take_off(float(altitude))
            case ["telemetry", "on" | "off" as order]:
                self._telemetry_on = order == "on"
            case ["shift", *numbers] if len(numbers) == 4:
                *shift, turn = map(float, numbers)
                self.vehicle.shift = self.vehicle.shift + np.array(shift)
                self.vehicle.turn_rad += turn
            case ["state"]:
                body = self.vehicle.body
                tell("state", mode=self.mode, armed=self.armed, position=body.position.tolist(),
                     velocity=body.velocity.tolist(), yaw_rad=body.yaw_rad)
            case _:
                tell("unknown", line=" ".join(words))

    def _receive(self, message, endpoint: Endpoint) -> None:
        name = message.get_type()
        companion = endpoint is self._companion
        if name in TOLD and companion:
            fields = {key: plain(value) for key, value in message.to_dict().items() if key != "mavpackettype"}
            tell("message", name=name, system=message.get_srcSystem(), component=message.get_srcComponent(),
                 fields=fields)
        if name == "SET_POSITION_TARGET_LOCAL_NED" and companion:
            self._target = message
            self.rules.setpoint(time.monotonic())
        elif name == "COMMAND_LONG":
            self._command(message, endpoint)
        elif name == "PARAM_REQUEST_READ":
            self.parameters.answer(message, endpoint.link)
        elif name == "TIMESYNC" and message.tc1 == 0:
            endpoint.link.timesync_send(time.monotonic_ns(), message.ts1)

    def _command(self, command, endpoint: Endpoint) -> None:
        result = mavlink.MAV_RESULT_UNSUPPORTED
        if command.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            if endpoint.telemetry.set_interval(int(command.param1), command.param2 * 1e-6):
                result = mavlink.MAV_RESULT_ACCEPTED
        elif command.command == mavlink.MAV_CMD_DO_SET_MODE:
            wanted = self.rules.custom_mode_of(command)
            mode = next((name for name, number in self.rules.MODES.items() if number == wanted), "")
            accepted = self._switch(mode, "command")
            result = mavlink.MAV_RESULT_ACCEPTED if accepted else mavlink.MAV_RESULT_DENIED
        elif command.command == mavlink.MAV_CMD_COMPONENT_ARM_DISARM:
            self.armed = command.param1 > 0.5
            tell("armed", armed=self.armed, why="command")
            result = mavlink.MAV_RESULT_ACCEPTED
        endpoint.link.command_ack_send(command.command, result, 0, 0, command.get_srcSystem(),
                                       command.get_srcComponent())

    def _step(self, now: float) -> None:
        external = self.mode == self.rules.EXTERNAL
        lost = self.rules.lost(now)
        if external and lost and self.mode != self.rules.FAILSAFE:
            self._switch(self.rules.FAILSAFE, "setpoints lost")
        while now - self._stepped >= STEP_S:
            self._stepped += STEP_S
            if not self.armed:
                self.vehicle.stand()
            elif external and not lost and self._target:
                self.vehicle.follow(self._target, STEP_S)
                self.vehicle.stop_here()
            else:
                self.vehicle.hold(STEP_S)


class PilotLines:
    """Whole lines from the standard input, as they come."""

    def __init__(self) -> None:
        self.gone = False
        self._rest = b""

    def fileno(self) -> int:
        return sys.stdin.fileno()

    def lines(self) -> list[str]:
        data = os.read(sys.stdin.fileno(), 4096)
        self.gone = not data
        *whole, self._rest = (self._rest + data).split(b"\n")
        return [line.decode() for line in whole]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rules", choices=RULES, default="px4")
    parser.add_argument("--loss", type=float, metavar="S", help="time without setpoints that ends external control")
    parser.add_argument("--system", type=int, default=1, metavar="ID", help="be this MAVLink system, 1 .. 255")
    wire = parser.add_mutually_exclusive_group(required=True)
    wire.add_argument("--udp", type=int, metavar="PORT", help="send to a companion that listens at this port")
    wire.add_argument("--tcp", action="store_true", help="listen for a companion")
    wire.add_argument("--serial", action="store_true", help="be the far end of a serial line")
    parser.add_argument("--truth-udp", type=int, metavar="PORT",
                        help="tell a simulator of the sensors that listens at this port where the vehicle really is")
    parser.add_argument("--altitude", type=float, default=0.0, metavar="M", help="begin armed, hovering at it")
    parser.add_argument("--heading", type=float, default=0.0, metavar="DEG", help="begin so, clockwise from north")
    parser.add_argument("--param", action="append", default=[], metavar="NAME=VALUE",
                        help="tell this value of a parameter, which is not obeyed; may be repeated")
    arguments = parser.parse_args()
    parameters = {name: float(value) for name, value in (setting.split("=", 1) for setting in arguments.param)}
    transport = Udp(arguments.udp) if arguments.udp else Tcp() if arguments.tcp else Serial()
    truth_transport = Udp(arguments.truth_udp) if arguments.truth_udp else None
    vehicle = Vehicle(arguments.altitude, math.radians(arguments.heading))
    with contextlib.suppress(KeyboardInterrupt):
        Autopilot(arguments.rules, arguments.loss, vehicle, transport, truth_transport,
                  parameters, arguments.system).run()


if __name__ == "__main__":
    main()
