"""What befalls the real flight process in mid-flight: it does not collide."""

import os
import signal
import sys
import time
import unittest

from cases import VEHICLE_RADIUS_M, FlightTest
from live_flight import live_flight
from simulated_pilot import SETPOINT

UINT32 = 1 << 32


class FaultFlight(FlightTest):
    def assert_survives(self, *sim_arguments: str) -> list[str]:
        """What the pilot has read."""
        with live_flight(self.options(duration_s=45.0, sim_arguments=sim_arguments)) as flight:
            flight.hand_over()
            code = flight.wait()
            what_happened = self.what_happened(flight)
            outcome, _, _, clearance_m = self.judged(flight)
            self.assertEqual((code, outcome), (0, "at the goal"), what_happened)
            self.assertGreaterEqual(clearance_m, VEHICLE_RADIUS_M, what_happened)
            return flight.pilot.texts()

    def test_camera_off_for_a_second(self):
        texts = self.assert_survives("--camera-off", "5:1")
        self.assertTrue(any(text.startswith("NanoMap brakes, without: ") for text in texts), texts)
        self.assertGreaterEqual(texts.count("NanoMap flies"), 2, texts)

    def test_estimators_world_jumps_by_a_metre(self):
        self.assert_survives("--vio-jump", "5:1")

    def test_process_stopped_for_two_seconds(self):
        """Nothing that was meant for a moment before the stop is flown after it."""
        with live_flight(self.options(duration_s=20.0, loss_s=0.3)) as flight:
            pilot = flight.pilot
            flight.hand_over()
            pilot.until(lambda: speed_m_s(pilot.messages(SETPOINT)[-1]) > 3.0, 20.0, "a fast setpoint")
            os.kill(flight.flight.pid, signal.SIGSTOP)
            stopped_at_s = time.monotonic()
            pilot.until(lambda: "HOLD" in pilot.modes(), 5.0, "the failsafe")
            time.sleep(max(0.0, stopped_at_s + 2.0 - time.monotonic()))
            before = len(pilot.messages(SETPOINT))
            resumed_at_s = time.monotonic()
            os.kill(flight.flight.pid, signal.SIGCONT)
            flight.wait()
            what_happened = self.what_happened(flight)
            outcome, _, _, clearance_m = self.judged(flight)
            self.assertEqual(outcome, "still under way", what_happened)  # it stands where the autopilot holds it
            self.assertGreaterEqual(clearance_m, VEHICLE_RADIUS_M, what_happened)
            self.assertEqual(pilot.modes(), ["OFFBOARD", "HOLD"], what_happened)
            after = pilot.messages(SETPOINT)[before:]
            stale = [message for message in after if age_s(message, resumed_at_s) > 0.0]
            self.assertLessEqual(len(stale), 1, what_happened)  # MAVSDK may have had one on its way
            self.assertTrue(all(speed_m_s(message) < 0.5 for message in after[1:]), what_happened)


def speed_m_s(setpoint: dict) -> float:
    return sum(setpoint["fields"][axis] ** 2 for axis in ("vx", "vy", "vz")) ** 0.5


def age_s(setpoint: dict, now_s: float) -> float:
    """How long before `now_s` it was stamped; negative for later. Its clock is this machine's, in 32-bit ms."""
    since_ms = (round(now_s * 1000) - setpoint["fields"]["time_boot_ms"]) % UINT32
    return (since_ms - UINT32 if since_ms > UINT32 // 2 else since_ms) / 1000


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
