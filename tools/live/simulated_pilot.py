"""tools/autopilot as a program beside this one, and its pilot, who is us."""

import contextlib
import json
import math
import sys
from collections.abc import Callable
from pathlib import Path

from child import Child

PROGRAM = Path(__file__).parents[1] / "autopilot" / "nanomap_autopilot.py"
START_S = 30.0  # Python starts slowly on a loaded machine
READY_S = 40.0  # the flight process: threads, streams, alignment
READY = "NanoMap ready"
SETPOINT = "SET_POSITION_TARGET_LOCAL_NED"
STREAM_MESSAGES = 60  # more than a second of them at 50 Hz: PX4 takes no OFFBOARD without


class SimulatedPilot:
    """The autopilot's vehicle hovers, armed, from the start."""

    def __init__(self, stack: contextlib.ExitStack, folder: Path, port: int, truth_port: int, altitude_m: float,
                 heading_deg: float, loss_s: float, heard: Callable[[str], None]):
        """`stack` ends it. `heard` is called with each text that the flight process has for its pilot, from another
        thread."""
        self.events: list[dict] = []  # as the autopilot printed them
        self._heard = heard
        self._child = stack.enter_context(Child(
            [sys.executable, PROGRAM, "--udp", port, "--truth-udp", truth_port, "--altitude", altitude_m,
             "--heading", heading_deg, "--loss", loss_s], folder / "autopilot.jsonl", self._note,
            realtime=True))
        self.until(lambda: bool(self.events), START_S, "its first word")

    def hand_over(self, check: Callable[[], None] = lambda: None) -> None:
        """Switches to OFFBOARD once the flight process says that it is ready, and has streamed setpoints for a while.

        `check` is called meanwhile; what it raises ends the wait.
        """
        def checked(condition: Callable[[], bool]) -> Callable[[], bool]:
            return lambda: (check(), condition())[1]

        self.until(checked(lambda: any(text.startswith(READY) for text in self.texts())), READY_S, f"'{READY}'")
        heard = len(self.messages(SETPOINT))
        self.until(checked(lambda: len(self.messages(SETPOINT)) >= heard + STREAM_MESSAGES), READY_S, "setpoints")
        switches = len(self.modes())
        self.order("mode OFFBOARD")
        self.until(lambda: self.modes()[switches:] == ["OFFBOARD"], START_S, "OFFBOARD")

    def order(self, line: str) -> None:
        """As the vehicle's pilot, in the words of tools/autopilot."""
        self._child.order(line)

    def speed_m_s(self) -> float:
        """Of the vehicle, in truth, now."""
        def told() -> list[dict]:
            return [event for event in list(self.events) if event["event"] == "state"]

        before = len(told())
        self.order("state")
        self.until(lambda: len(told()) > before, START_S, "where the vehicle is")
        return math.hypot(*told()[-1]["velocity"])

    def until(self, condition: Callable[[], bool], timeout_s: float, what: str) -> None:
        self._child.until(condition, timeout_s, what)

    def texts(self) -> list[str]:
        """Whole ones: a long text comes in chunks of one number."""
        texts: list[str] = []
        for message in self.messages("STATUSTEXT"):
            fields = message["fields"]
            if fields["id"] != 0 and fields["chunk_seq"] > 0 and texts:
                texts[-1] += fields["text"]
            else:
                texts.append(fields["text"])
        return texts

    def modes(self) -> list[str]:
        return [event["mode"] for event in list(self.events) if event["event"] == "mode"]

    def messages(self, name: str) -> list[dict]:
        return [event for event in list(self.events) if event["event"] == "message" and event["name"] == name]

    def _note(self, line: str) -> None:
        if not line.startswith("{"):
            return
        event = json.loads(line)
        self.events.append(event)
        if event["event"] == "message" and event["name"] == "STATUSTEXT":
            self._heard(event["fields"]["text"])
