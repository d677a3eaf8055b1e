"""The real flight process through each scene: LCM, MAVLink and real time."""

import sys
import unittest

from cases import VEHICLE_RADIUS_M, FlightTest
from live_flight import live_flight


class SceneFlight(FlightTest):
    def assert_arrives(self, scene: str, top_speed_m_s: float, duration_s: float = 60.0) -> None:
        with live_flight(self.options(scene=scene, duration_s=duration_s)) as flight:
            flight.hand_over()
            code = flight.wait()
            what_happened = self.what_happened(flight)
            outcome, _, top_m_s, clearance_m = self.judged(flight)
            self.assertEqual((code, outcome), (0, "at the goal"), what_happened)
            self.assertGreaterEqual(clearance_m, VEHICLE_RADIUS_M, what_happened)
            self.assertGreater(top_m_s, top_speed_m_s, what_happened)
            self.assertEqual(flight.pilot.modes(), ["OFFBOARD"], "the autopilot had no reason to step in")
            self.assertIn("NanoMap: at the goal", flight.pilot.texts(), what_happened)
        self.assertEqual(flight.flight.poll(), 0, "it ends cleanly when it is asked to")

    def test_forest(self):
        self.assert_arrives("forest", 6.0)

    def test_warehouse(self):
        self.assert_arrives("warehouse", 6.0)

    def test_wall_with_overhang(self):
        """It is wider than the camera sees: the way round it is a matter of memory."""
        self.assert_arrives("wall", 6.0, duration_s=90.0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
