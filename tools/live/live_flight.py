"""The flight process, the simulated world around it and an autopilot: real programs that meet over LCM and MAVLink."""

import contextlib
import os
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path

from child import Child
from ports import free_udp_ports
from simulated_pilot import SimulatedPilot

SIM_START_S = 90.0  # it waits for an autopilot for a minute
AFTER_DURATION_S = 30.0
ROUND_S = 0.2
PLACED = "lies around the vehicle"
HIGHEST_PRIORITY = -20  # as nice counts
MISSION_ALTITUDE_M = {"forest": 2.0, "wall": 5.0, "warehouse": 1.6, "urban": 3.0}


@dataclass(frozen=True)
class OwnAutopilot:
    """One that the user runs, with where it sends to the flight process, and to the simulated world."""

    url: str
    truth_url: str


@dataclass(frozen=True)
class LiveFlightOptions:
    programs: Path  # the folder of nanomap-sim and nanomap-flight
    folder: Path  # for what the programs say and record
    scene: str = "forest"
    autopilot: OwnAutopilot | None = None  # None: tools/autopilot, with us as its pilot
    heading_deg: float = 40.0  # of the vehicle of tools/autopilot, and of its way: the flight process has to find out
    loss_s: float = 1.0  # its COM_OF_LOSS_T
    duration_s: float = 120.0  # to give up after
    sim_arguments: tuple[str, ...] = ()
    flight_arguments: tuple[str, ...] = ()
    tell: Callable[[str], None] = lambda text: None  # is called with what happens, from several threads

    @property
    def sim_log(self) -> Path:
        return self.folder / "sim.lcmlog"

    @property
    def recordings(self) -> Path:
        """The folder that the flight process records in."""
        return self.folder / "recordings"


class LiveFlight:
    """Three programs; one with an autopilot of the user's has no pilot."""

    def __init__(self, options: LiveFlightOptions, stack: contextlib.ExitStack):
        """The vehicle of tools/autopilot hovers at the scene's start. `stack` ends the programs."""
        self.options = options
        lcm_port, port, truth_port = free_udp_ports(3)
        own = options.autopilot or OwnAutopilot(f"udpin://127.0.0.1:{port}", f"udpin://127.0.0.1:{truth_port}")
        lcm = f'lcm.url="udpm://239.255.76.67:{lcm_port}?ttl=0"'
        self.pilot = None if options.autopilot else SimulatedPilot(
            stack, options.folder, port, truth_port, MISSION_ALTITUDE_M[options.scene], options.heading_deg,
            options.loss_s, lambda text: options.tell(f"the pilot reads: {text}"))
        self.sim = stack.enter_context(Child(
            [options.programs / "nanomap-sim", "--live", "--scene", options.scene, "--duration", options.duration_s,
             "--autopilot", own.truth_url, "--set", lcm, "--out", options.sim_log, *options.sim_arguments],
            options.folder / "sim.txt", lambda line: options.tell(f"nanomap-sim: {line}"),
            realtime=True))
        self.sim.until(lambda: any(PLACED in line for line in self.sim.lines()), SIM_START_S, "the scene")
        self._stack = stack
        self._flight_command = [
            options.programs / "nanomap-flight", "--allow-no-realtime", "--set", lcm, "--set",
            f'mavlink.url="{own.url}"', "--record", options.recordings, *options.flight_arguments]
        self.flight = self._started("flight.txt")

    def start_again(self) -> None:
        """The flight process, which has ended."""
        self.flight = self._started("flight_again.txt")

    def _started(self, lines_file: str) -> Child:
        return self._stack.enter_context(Child(self._flight_command, self.options.folder / lines_file))

    def hand_over(self) -> None:
        """As the pilot of tools/autopilot: lets the flight process fly."""
        self.pilot.hand_over(self.check)

    def check(self) -> None:
        """Raises RuntimeError naming the program that has ended before its time."""
        for child in (self.sim, self.flight):
            if child.poll() is not None:
                raise RuntimeError(f"{child.name} has ended: {child.last_words()}")

    def wait(self) -> int:
        """Until the simulated world has seen enough. Its exit code: 0 at the goal.

        Raises RuntimeError if the flight process ends before.
        """
        waited_s = 0.0
        while self.sim.poll() is None and waited_s < self.options.duration_s + AFTER_DURATION_S:
            if self.flight.poll() is not None:
                raise RuntimeError(f"{self.flight.name} has ended in flight: {self.flight.last_words()}")
            with contextlib.suppress(TimeoutError):
                self.sim.wait(ROUND_S)
            waited_s += ROUND_S
        return self.sim.wait(ROUND_S)


@contextlib.contextmanager
def live_flight(options: LiveFlightOptions) -> Iterator[LiveFlight]:
    """All programs have ended afterwards."""
    options.folder.mkdir(parents=True, exist_ok=True)
    with contextlib.suppress(PermissionError):  # the flight process has threads that are not in real time, too
        os.setpriority(os.PRIO_PROCESS, 0, HIGHEST_PRIORITY)
    with contextlib.ExitStack() as stack:
        yield LiveFlight(options, stack)
