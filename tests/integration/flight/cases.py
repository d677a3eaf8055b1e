"""What the tests of whole flights have in common; NANOMAP_PROGRAMS is the folder of the programs."""

import os
import re
import tempfile
import unittest
from pathlib import Path

from live_flight import LiveFlightOptions

SUMMARY = re.compile(r"scene '(?P<scene>\w+)', seed \d+: (?P<outcome>.+) after (?P<s>[\d.]+) s and (?P<m>[\d.]+) m")
SPEED = re.compile(r"speed: mean (?P<mean>[\d.]+) m/s, top (?P<top>[\d.]+) m/s; clearance (?P<clearance>[\d.]+) m")
VEHICLE_RADIUS_M = 0.4  # MulticopterParameters::radius_m


class FlightTest(unittest.TestCase):
    def setUp(self):
        holder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        self.addCleanup(holder.cleanup)
        self.folder = Path(holder.name)

    def options(self, **options) -> LiveFlightOptions:
        return LiveFlightOptions(programs=Path(os.environ["NANOMAP_PROGRAMS"]), folder=self.folder, **options)

    def judged(self, flight) -> tuple[str, float, float, float]:
        """Outcome, mean and top speed in m/s and least clearance in m, as the simulated world says."""
        text = "\n".join(flight.sim.lines())
        summary, speed = SUMMARY.search(text), SPEED.search(text)
        self.assertTrue(summary and speed, text)
        print(f"{self.id()}: {summary[0]}; {speed[0]}", flush=True)
        return summary["outcome"], float(speed["mean"]), float(speed["top"]), float(speed["clearance"])

    def what_happened(self, flight) -> str:
        """For the message of a failure."""
        return "\n".join([*flight.sim.lines(), *flight.pilot.texts(), *flight.flight.lines()[-20:]])
