"""An autopilot to test a companion against: a point mass under PX4's OFFBOARD or ArduCopter's GUIDED rules.

What it receives and decides it prints, one JSON object a line, beginning with its URL. Its pilot sits at the standard
input; the program ends with it:
  mode NAME            switch the mode; PX4 refuses OFFBOARD without a stream of setpoints
  arm | disarm
  telemetry on | off   "off" is a link that has gone dead
  shift N E D YAW      its estimate is corrected by so many m and rad
  state                print where the vehicle is
"""

import argparse
import json
import math
import os
import select
import sys
import time

import telemetry as streams
from flight_rules import RULES
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


class Autopilot:
    def __init__(self, rules_name: str, loss_s: float | None, transport):
        rules, usual_loss_s = RULES[rules_name]
        self.rules = rules(usual_loss_s if loss_s is None else loss_s)
        self.vehicle = Vehicle()
        self.mode = next(iter(self.rules.MODES))
        self.armed = False
        self._transport = transport
        self._start = time.monotonic()
        self._target = None
        self._hold_at = list(self.vehicle.position)
        self._telemetry_on = True
        self._link = mavlink.MAVLink(transport, srcSystem=1, srcComponent=mavlink.MAV_COMP_ID_AUTOPILOT1)
        self._parser = mavlink.MAVLink(None)
        self._parser.robust_parsing = True
        self._telemetry = streams.Telemetry(self._link, rules_name)
        self._stepped = self._start

    def boot_ms(self, now: float) -> int:
        return int((now - self._start) * 1000)

    def run(self) -> None:
        tell("ready", url=self._transport.url, boot_s=self._start)
        pilot = PilotLines()
        while not pilot.gone:
            for message in self._parser.parse_buffer(self._transport.wait(STEP_S)) or []:
                self._receive(message)
            for line in pilot.lines():
                self._obey(line.split())
            now = time.monotonic()
            self._step(now)
            if self._telemetry_on:
                self._telemetry.send_due(now, self)

    def _switch(self, mode: str, why: str) -> bool:
        now = time.monotonic()
        if mode not in self.rules.MODES or (mode == self.rules.EXTERNAL and not self.rules.accepts_external(now)):
            tell("refused", mode=mode)
            return False
        self.mode = mode
        self._hold_at = list(self.vehicle.position)
        self._telemetry.send_now(streams.HEARTBEAT)
        tell("mode", mode=mode, why=why)
        return True

    def _obey(self, words: list[str]) -> None:
        match words:
            case ["mode", mode]:
                self._switch(mode, "pilot")
            case ["arm" | "disarm" as order]:
                self.armed = order == "arm"
                self._telemetry.send_now(streams.HEARTBEAT)
            case ["telemetry", "on" | "off" as order]:
                self._telemetry_on = order == "on"
            case ["shift", *numbers] if len(numbers) == 4:
                *shift, turn = map(float, numbers)
                self.vehicle.shift = [a + b for a, b in zip(self.vehicle.shift, shift)]
                self.vehicle.turn_rad += turn
            case ["state"]:
                tell("state", mode=self.mode, armed=self.armed, position=self.vehicle.told_position(),
                     velocity=self.vehicle.velocity, yaw_rad=self.vehicle.told_yaw_rad())
            case _:
                tell("unknown", line=" ".join(words))

    def _receive(self, message) -> None:
        name = message.get_type()
        if name in TOLD:
            fields = {key: plain(value) for key, value in message.to_dict().items() if key != "mavpackettype"}
            tell("message", name=name, system=message.get_srcSystem(), component=message.get_srcComponent(),
                 fields=fields)
        if name == "SET_POSITION_TARGET_LOCAL_NED":
            self._target = message
            self.rules.setpoint(time.monotonic())
        elif name == "COMMAND_LONG":
            self._command(message)
        elif name == "TIMESYNC" and message.tc1 == 0:
            self._link.timesync_send(time.monotonic_ns(), message.ts1)

    def _command(self, command) -> None:
        result = mavlink.MAV_RESULT_UNSUPPORTED
        if command.command == mavlink.MAV_CMD_SET_MESSAGE_INTERVAL:
            if self._telemetry.set_interval(int(command.param1), command.param2 * 1e-6):
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
        self._link.command_ack_send(command.command, result, 0, 0, command.get_srcSystem(),
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
                self._hold_at = list(self.vehicle.position)
            else:
                self.vehicle.hold(self._hold_at, STEP_S)


class PilotLines:
    """Whole lines from the standard input, as they come."""

    def __init__(self) -> None:
        self.gone = False
        self._rest = b""

    def lines(self) -> list[str]:
        if not select.select([sys.stdin], [], [], 0)[0]:
            return []
        data = os.read(sys.stdin.fileno(), 4096)
        self.gone = not data
        *whole, self._rest = (self._rest + data).split(b"\n")
        return [line.decode() for line in whole]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--rules", choices=RULES, default="px4")
    parser.add_argument("--loss", type=float, metavar="S", help="time without setpoints that ends external control")
    wire = parser.add_mutually_exclusive_group(required=True)
    wire.add_argument("--udp", type=int, metavar="PORT", help="send to a companion that listens at this port")
    wire.add_argument("--tcp", action="store_true", help="listen for a companion")
    wire.add_argument("--serial", action="store_true", help="be the far end of a serial line")
    arguments = parser.parse_args()
    transport = Udp(arguments.udp) if arguments.udp else Tcp() if arguments.tcp else Serial()
    Autopilot(arguments.rules, arguments.loss, transport).run()


if __name__ == "__main__":
    main()
