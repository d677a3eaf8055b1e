"""What befalls the real flight process in mid-flight, and what must come of it by firmware_app/safety/state_machine.h:
it flies on, or comes to a standstill and leaves the vehicle to the autopilot's failsafe; and never collides."""

import contextlib
import os
import signal
import sys
import time
import unittest
from collections.abc import Iterator

from cases import VEHICLE_RADIUS_M, FlightTest
from live_flight import LiveFlight, live_flight
from recorded_setpoints import stale_setpoints
from simulated_pilot import SETPOINT

UINT32 = 1 << 32
SETPOINTS_PER_S = 50
BEFALLS_S = 2.5  # after the departure: it flies at more than 4 m/s by then
FOR_GOOD_S = 600
PATIENCE_S = 25.0
STANDS_M_S = 0.4
FLIES = "NanoMap flies"


def fault(what: str, lasts_s: float) -> tuple[str, str]:
    return "--fault", f"{what}:{BEFALLS_S}:{lasts_s}"


class FaultFlight(FlightTest):
    @contextlib.contextmanager
    def in_flight(self, *sim_arguments: str, **options) -> Iterator[LiveFlight]:
        """Whatever happens within: the vehicle has not touched anything, and nothing stale was sent."""
        with live_flight(self.options(duration_s=90.0, sim_arguments=sim_arguments, **options)) as flight:
            flight.hand_over()
            try:
                yield flight
            except TimeoutError as error:
                self.fail(f"{error}\n{self.what_happened(flight)}")
            flight.sim.end()
            what_happened = self.what_happened(flight)
            outcome, _, _, clearance_m = self.judged(flight)
        self.assertNotEqual(outcome, "collision", what_happened)
        self.assertGreaterEqual(clearance_m, VEHICLE_RADIUS_M, what_happened)
        self.assertEqual(stale_setpoints(flight.options.recordings), [], what_happened)

    def assert_survives(self, without: str, *sim_arguments: str) -> None:
        """It brakes for want of that, and flies on or lets go once it is there again."""
        with self.in_flight(*sim_arguments, loss_s=0.3) as flight:
            self.await_an_end(flight)
            self.assert_braked(flight, without)

    def await_an_end(self, flight: LiveFlight) -> None:
        """It flies on; or has stopped where it finds no plan, so near to something, and lets go."""
        pilot = flight.pilot
        pilot.until(lambda: pilot.texts().count(FLIES) >= 2 or "HOLD" in pilot.modes(), PATIENCE_S, "an end of it")
        if "HOLD" in pilot.modes():
            self.await_failsafe(flight)
        else:
            self.await_speed(flight, 1.0)

    def assert_takes_no_notice(self, *sim_arguments: str) -> None:
        with self.in_flight(*sim_arguments) as flight:
            pilot = flight.pilot
            pilot.until(lambda: speed_m_s(pilot.messages(SETPOINT)[-1]) > 2.0, PATIENCE_S, "a fast setpoint")
            begun = len(pilot.messages(SETPOINT))
            pilot.until(lambda: len(pilot.messages(SETPOINT)) > begun + 6 * SETPOINTS_PER_S, PATIENCE_S, "setpoints")
            self.assertEqual(pilot.texts().count(FLIES), 1, self.what_happened(flight))
            self.assertEqual(pilot.modes(), ["OFFBOARD"], self.what_happened(flight))

    def assert_lets_go(self, without: str, *sim_arguments: str) -> None:
        """It brakes for want of that, stands, and leaves the vehicle to the autopilot's failsafe."""
        with self.in_flight(*sim_arguments, loss_s=0.3) as flight:
            self.await_failsafe(flight)
            self.assert_braked(flight, without)
            self.assertTrue(any(text.startswith("NanoMap has let go") for text in flight.pilot.texts()),
                            self.what_happened(flight))

    def await_failsafe(self, flight: LiveFlight) -> None:
        """The vehicle stands when the failsafe acts."""
        pilot = flight.pilot
        pilot.until(lambda: "HOLD" in pilot.modes(), PATIENCE_S, "the failsafe")
        self.assertLess(pilot.speed_m_s(), STANDS_M_S, self.what_happened(flight))
        self.assertEqual(pilot.modes(), ["OFFBOARD", "HOLD"], self.what_happened(flight))

    def assert_braked(self, flight: LiveFlight, without: str) -> None:
        texts = flight.pilot.texts()
        self.assertTrue(any(text.startswith("NanoMap brakes, without: ") for text in texts), self.what_happened(flight))
        self.assertTrue(any("without: " in text.lower() and without in text for text in texts),
                        self.what_happened(flight))

    def test_camera_off_for_a_second(self):
        self.assert_survives("depth images", "--camera-off", f"{BEFALLS_S}:1")

    def test_camera_off_for_good(self):
        self.assert_lets_go("depth images", "--camera-off", f"{BEFALLS_S}:{FOR_GOOD_S}")

    def test_camera_frozen(self):
        self.assert_lets_go("depth images that change", *fault("camera-frozen", FOR_GOOD_S))

    def test_camera_late(self):
        self.assert_lets_go("depth images", *fault("camera-late", FOR_GOOD_S))

    def test_camera_flickers(self):
        """Frames are never missing for long, and never there for long."""
        self.assert_lets_go("a plan", *fault("camera-flickers", FOR_GOOD_S))

    def test_camera_sends_garbage(self):
        self.assert_lets_go("depth images", *fault("camera-garbage", FOR_GOOD_S))

    def test_poses_off_for_a_second(self):
        self.assert_survives("poses", "--vio-off", f"{BEFALLS_S}:1")

    def test_poses_off_for_good(self):
        self.assert_lets_go("poses", "--vio-off", f"{BEFALLS_S}:{FOR_GOOD_S}")

    def test_poses_late(self):
        self.assert_lets_go("poses", *fault("poses-late", FOR_GOOD_S))

    def test_poses_are_not_a_number(self):
        self.assert_lets_go("poses", *fault("poses-nan", FOR_GOOD_S))

    def test_estimators_world_jumps_by_a_metre(self):
        self.assert_survives("alignment", "--vio-jump", f"{BEFALLS_S}:1")

    def test_corrections_jump(self):
        self.assert_takes_no_notice("--correction-hz", "5", *fault("corrections-jump", 3))

    def test_goal_is_nonsense(self):
        self.assert_takes_no_notice(*fault("goal-nonsense", 3))

    def test_flood_of_junk(self):
        self.assert_takes_no_notice(*fault("flood", 3))

    def test_autopilot_silent_for_two_seconds(self):
        with self.in_flight(loss_s=5.0) as flight:
            pilot = flight.pilot
            self.await_speed(flight)
            pilot.order("telemetry off")
            pilot.until(lambda: any("brakes" in text for text in pilot.texts()), 2.0, "that it brakes")
            begun = len(pilot.messages(SETPOINT))
            pilot.until(lambda: len(pilot.messages(SETPOINT)) > begun + SETPOINTS_PER_S, PATIENCE_S, "setpoints")
            pilot.order("telemetry on")
            self.await_an_end(flight)
            self.assert_braked(flight, "alignment")

    def test_autopilot_silent_for_good(self):
        with self.in_flight(loss_s=0.3) as flight:
            self.await_speed(flight)
            flight.pilot.order("telemetry off")
            self.await_failsafe(flight)
            self.assert_braked(flight, "alignment")

    def test_pilot_takes_over_and_gives_back(self):
        with self.in_flight() as flight:
            pilot = flight.pilot
            self.await_speed(flight)
            pilot.order("mode POSCTL")
            pilot.until(lambda: "POSCTL" in pilot.modes(), 5.0, "the pilot's mode")
            pilot.until(lambda: speed_m_s(pilot.messages(SETPOINT)[-1]) == 0.0, 5.0, "that it holds")
            begun = len(pilot.messages(SETPOINT))
            pilot.until(lambda: len(pilot.messages(SETPOINT)) > begun + SETPOINTS_PER_S, PATIENCE_S, "setpoints")
            self.assertTrue(all(speed_m_s(each) == 0.0 for each in pilot.messages(SETPOINT)[begun:]))
            self.assertLess(pilot.speed_m_s(), STANDS_M_S, self.what_happened(flight))
            pilot.order("mode OFFBOARD")
            self.await_speed(flight)
            self.assertEqual(pilot.modes(), ["OFFBOARD", "POSCTL", "OFFBOARD"], self.what_happened(flight))

    def test_process_killed_and_started_again(self):
        """It never flies by itself: only after a fresh switch."""
        with self.in_flight(loss_s=0.3) as flight:
            pilot = flight.pilot
            self.await_speed(flight)
            flight.flight.kill()
            pilot.until(lambda: "HOLD" in pilot.modes(), PATIENCE_S, "the failsafe")
            before = len(pilot.messages(SETPOINT))
            flight.start_again()
            pilot.until(lambda: len(pilot.messages(SETPOINT)) > before + SETPOINTS_PER_S, PATIENCE_S, "setpoints")
            self.assertTrue(all(speed_m_s(each) == 0.0 for each in pilot.messages(SETPOINT)[before:]))
            self.assertEqual(pilot.modes(), ["OFFBOARD", "HOLD"], self.what_happened(flight))
            flight.hand_over()
            self.await_speed(flight)

    def test_process_told_to_end(self):
        """It stands before its stream ends: an autopilot flies on by the last setpoint for a while."""
        with self.in_flight(loss_s=0.3) as flight:
            self.await_speed(flight)
            self.assertEqual(flight.flight.end(), 0)
            self.assertLess(speed_m_s(flight.pilot.messages(SETPOINT)[-1]), 0.1, self.what_happened(flight))
            self.await_failsafe(flight)
            self.assert_braked(flight, "told to end")

    def test_process_stopped_for_two_seconds(self):
        """Nothing that was meant for a moment before the stop is flown after it."""
        with self.in_flight(loss_s=0.3) as flight:
            pilot = flight.pilot
            self.await_speed(flight)
            os.kill(flight.flight.pid, signal.SIGSTOP)
            stopped_at_s = time.monotonic()
            pilot.until(lambda: "HOLD" in pilot.modes(), 5.0, "the failsafe")
            time.sleep(max(0.0, stopped_at_s + 2.0 - time.monotonic()))
            before = len(pilot.messages(SETPOINT))
            resumed_at_s = time.monotonic()
            os.kill(flight.flight.pid, signal.SIGCONT)
            pilot.until(lambda: len(pilot.messages(SETPOINT)) > before + SETPOINTS_PER_S, PATIENCE_S, "setpoints")
            what_happened = self.what_happened(flight)
            self.assertEqual(pilot.modes(), ["OFFBOARD", "HOLD"], what_happened)
            after = pilot.messages(SETPOINT)[before:]
            stale = [message for message in after if age_s(message, resumed_at_s) > 0.0]
            self.assertLessEqual(len(stale), 1, what_happened)  # MAVSDK may have had one on its way
            self.assertTrue(all(speed_m_s(message) < 0.5 for message in after[1:]), what_happened)

    def await_speed(self, flight: LiveFlight, more_than_m_s: float = 3.0) -> None:
        pilot = flight.pilot
        pilot.until(lambda: speed_m_s(pilot.messages(SETPOINT)[-1]) > more_than_m_s, PATIENCE_S, "a fast setpoint")


def speed_m_s(setpoint: dict) -> float:
    return sum(setpoint["fields"][axis] ** 2 for axis in ("vx", "vy", "vz")) ** 0.5


def age_s(setpoint: dict, now_s: float) -> float:
    """How long before `now_s` it was stamped; negative for later. Its clock is this machine's, in 32-bit ms."""
    since_ms = (round(now_s * 1000) - setpoint["fields"]["time_boot_ms"]) % UINT32
    return (since_ms - UINT32 if since_ms > UINT32 // 2 else since_ms) / 1000


if __name__ == "__main__":
    unittest.main(argv=sys.argv, verbosity=2)
