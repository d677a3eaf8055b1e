"""The real flight process through each scene: LCM, MAVLink and real time."""

import sys
import unittest

from cases import VEHICLE_RADIUS_M, FlightTest
from live_flight import live_flight


class SceneFlight(FlightTest):
    def assert_arrives(self, scene: str, top_speed_m_s: float) -> None:
        with live_flight(self.options(scene=scene, duration_s=60.0)) as flight:
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
        """It is wider than the camera sees: no planner of local motions gets around it. It stops and looks around."""
        with live_flight(self.options(scene="wall", duration_s=40.0)) as flight:
            flight.hand_over()
            flight.wait()
            what_happened = self.what_happened(flight)
            outcome, _, top_m_s, clearance_m = self.judged(flight)
            self.assertEqual(outcome, "still under way", what_happened)
            self.assertGreaterEqual(clearance_m, VEHICLE_RADIUS_M, what_happened)
            self.assertGreater(top_m_s, 6.0, what_happened)
            self.assertIn("NanoMap: blocked: looking around", flight.pilot.texts(), what_happened)
            self.assertEqual(flight.pilot.modes(), ["OFFBOARD"], what_happened)


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
