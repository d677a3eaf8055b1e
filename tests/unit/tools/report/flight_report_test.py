"""Tests of nanomap-report's picture of a whole flight with its decisions."""

import re
import tomllib
import unittest
from pathlib import Path
from unittest import mock

import candidates_panel
import flight_map_panel
import flight_picture
import latency_panel
import matplotlib.pyplot as plt
import nanomap
import numpy as np
from cases import ProgramTest, TemporaryFolderTest
from depth_points import measured_points
from flight import Flight, gather_flight
from flight_summary import summarise
from limits import DEFAULTS, Limits, read_limits
from map_frame import Frame, around
from nanomap_log import Channels, Status, read_told
from outcomes import OUTCOMES, Outcome
from seen_points import CLEARANCE_WITHIN_S, gather_seen_points
from synthetic_log import FRAME_US, HEIGHT, START_US, WIDTH, camera, decision, depth, goal, health, pose, write
from track import Track

ROOT = Path(__file__).parents[4]
CLOCKS_APART_US = 5_000_000  # the log's clock is ahead of the messages'
LIMITS = Limits(max_risk=0.002, vehicle_radius_m=0.3)
WALL_M = 3.0
BLOCKED = "blocked: looking around"
NOTHING = "nothing is safe, not even stopping: keep to the last verified brake"
FRAMES = 40
STEP_M = 0.1


def utime(frame: int) -> int:
    return START_US + frame * FRAME_US


def moving(frame: int, epoch: int = 0) -> nanomap.body_pose_t:
    message = pose(utime(frame), STEP_M * frame, epoch)
    message.velocity = [2.0 if frame == 3 else 1.0, 0.0, 0.0]
    return message


def flight_inputs() -> list[tuple[str, int, object]]:
    """Along x, in front of a wall that stays as far away; at the end another world begins, and the first goes on."""
    messages = [("CAMERA", START_US, camera()), ("GOAL", START_US, goal(START_US, 2.0, 0)),
                ("GOAL", START_US, goal(START_US, 7.0, 1))]
    for i in range(FRAMES):
        messages.append(("POSE_BODY", utime(i), moving(i)))
        messages.append(("DEPTH", utime(i), depth(utime(i), np.full((HEIGHT, WIDTH), 1000 * WALL_M), i % 2)))
    messages.append(("POSE_BODY", utime(FRAMES), moving(FRAMES, epoch=1)))
    messages.append(("POSE_BODY", utime(FRAMES), moving(FRAMES)))
    return [(channel, log_utime + CLOCKS_APART_US, message) for channel, log_utime, message in messages]


def flight_decisions() -> list[tuple[str, int, object]]:
    reasons = ["flying"] * 30 + [BLOCKED] * 6 + [NOTHING] * 4
    made = [decision(utime(i), STEP_M * i, reason, risk=1e-5 * (i + 1)) for i, reason in enumerate(reasons)]
    made[2].has_brake = False
    made.append(decision(utime(FRAMES - 1) + 1, STEP_M * FRAMES, "of a later version", epoch=1))
    return [("NANOMAP_DECISIONS", d.utime + CLOCKS_APART_US, d) for d in made]


class FlightTest(TemporaryFolderTest):
    def logs(self) -> tuple[Path, Path]:
        return (write(self.folder / "in.log", flight_inputs()),
                write(self.folder / "decisions.log", flight_decisions()))

    def own_log(self) -> Path:
        return write(self.folder / "own.log", flight_inputs() + flight_decisions())

    def flight(self) -> Flight:
        return gather_flight(*self.logs(), Channels(), LIMITS)


class Outcomes(unittest.TestCase):
    def test_know_every_reason_that_the_planner_gives(self):
        words = re.findall(r'return "(..+)";', (ROOT / "core/decision.cc").read_text())
        self.assertGreater(len(words), 10)
        self.assertLessEqual(set(words), set(OUTCOMES))  # which may know those of older logs too

    def test_look_different(self):
        for part in ("label", "colour"):
            self.assertEqual(len({getattr(kind.value, part) for kind in Outcome}), len(Outcome))


class LimitsTest(TemporaryFolderTest):
    def test_come_from_configuration_and_else_from_the_defaults(self):
        defaults = tomllib.loads(DEFAULTS.read_text())
        config = self.folder / "c.toml"
        config.write_text("[risk]\nmax_risk = 0.25\n")
        self.assertEqual(read_limits(read_told(config)), Limits(0.25, defaults["vehicle"]["radius_m"]))
        self.assertEqual(read_limits({}), Limits(defaults["risk"]["max_risk"], defaults["vehicle"]["radius_m"]))


class MeasuredPoints(unittest.TestCase):
    def test_lie_on_their_pixels_rays(self):
        counts = np.zeros((HEIGHT, WIDTH), np.uint16)
        counts[4, 8], counts[5, 8], counts[8, 12] = 2000, 3000, 65535  # the last beyond the camera's range
        raw = depth(0, counts, nanomap.depth_image_t.RAW)
        x, y = (8 - 15.5) / 16, (4 - 11.5) / 16
        np.testing.assert_allclose(measured_points(raw, camera(), every=4), [[2 * x, 2 * y, 2]])
        self.assertEqual(len(measured_points(raw, camera())), 2)


class SeenPointsTest(unittest.TestCase):
    def test_give_distance_to_nearest_point_measured_about_then(self):
        poses = [pose(START_US, 0.0), pose(START_US + 20_000_000, 20.0)]
        image = depth(START_US, np.full((HEIGHT, WIDTH), 1000 * WALL_M), nanomap.depth_image_t.RAW)
        seen = gather_seen_points([image], camera(), Track(poses))
        nearest_pixel = WALL_M * np.array([0.5, 0.5]) / 16  # beside the optical axis
        for after_us, away_m in ((0, WALL_M), (2_000_000, WALL_M - 2), (4_000_000, WALL_M - 4)):
            self.assertAlmostEqual(seen.clearance(Track(poses), START_US + after_us), np.hypot(
                away_m, np.linalg.norm(nearest_pixel)), places=5)
        self.assertTrue(np.isnan(seen.clearance(Track(poses), START_US + round((CLEARANCE_WITHIN_S + 0.1) * 1e6))))

    def test_leave_out_frames_without_pose_and_most_of_a_fast_camera(self):
        counts = np.full((HEIGHT, WIDTH), 1000, np.uint16)
        images = [depth(START_US + 10_000 * i, counts, nanomap.depth_image_t.RAW) for i in (25, 3, 2, 1, 0, -1)]
        seen = gather_seen_points(images, camera(), Track([pose(START_US, 0.0), pose(START_US + 200_000, 1.0)]))
        self.assertEqual(np.unique(seen.utimes).tolist(), [START_US])

    def test_know_nothing_of_an_unseen_world(self):
        track = Track([pose(0, 0.0), pose(1, 0.0)])
        self.assertTrue(np.isnan(gather_seen_points([], camera(), track).clearance(track, 0)))


class GatherFlight(FlightTest):
    def test_draws_world_of_most_decisions(self):
        flight = self.flight()
        self.assertEqual((flight.epoch, flight.own), (0, False))
        self.assertEqual((len(flight.decisions), len(flight.drawn_decisions())), (FRAMES + 1, FRAMES))
        self.assertEqual([g.position[0] for g in flight.goals], [2.0])

    def test_counts_time_from_the_logs_first_event(self):
        flight = self.flight()
        np.testing.assert_allclose(flight.decision_seconds[:3], [0, 0.033, 0.066], atol=1e-9)

    def test_takes_both_from_one_log(self):
        own = self.own_log()
        flight = gather_flight(own, own, Channels(), LIMITS)
        self.assertTrue(flight.own)
        self.assertEqual(summarise(flight), summarise(self.flight()))

    def test_takes_the_latest_flight_of_a_folder_of_recordings(self):
        folder = self.folder / "recordings"
        folder.mkdir()
        messages = sorted(flight_inputs() + flight_decisions(), key=lambda message: message[1])
        write(folder / "flight-000009-part-0001.lcmlog", messages[:10])
        write(folder / "flight-000010-part-0001.lcmlog", messages[:50])
        write(folder / "flight-000010-part-0002.lcmlog", messages[50:])
        flight = gather_flight(folder, folder, Channels(), LIMITS)
        self.assertTrue(flight.own)
        self.assertEqual(summarise(flight), summarise(self.flight()))

    def test_names_a_folder_without_recordings(self):
        with self.assertRaisesRegex(ValueError, "holds no recording of a flight"):
            gather_flight(self.folder, self.folder, Channels(), LIMITS)

    def test_names_what_a_log_lacks(self):
        log, decisions = self.logs()
        with self.assertRaisesRegex(ValueError, "in.log: holds no decisions on the channel NANOMAP_DECISIONS"):
            gather_flight(log, log, Channels(), LIMITS)
        later = write(self.folder / "later.log", [("NANOMAP_DECISIONS", 1, decision(1, 0.0))])
        with self.assertRaisesRegex(ValueError, "in.log: holds no poses of epoch 0 .* Do the two belong together"):
            gather_flight(log, later, Channels(), LIMITS)
        one_pose = write(self.folder / "one.log", [m for m in flight_inputs() if m[0] != "POSE_BODY" or
                                                   m[2].utime == START_US])
        with self.assertRaisesRegex(ValueError, "one.log: holds no poses of epoch 0"):
            gather_flight(one_pose, decisions, Channels(), LIMITS)


class SummaryTest(FlightTest):
    def test_counts_flight_and_plans(self):
        summary = summarise(self.flight())
        self.assertAlmostEqual(summary.distance_m, STEP_M * FRAMES)
        self.assertAlmostEqual(summary.duration_s, FRAMES * FRAME_US / 1e6)
        self.assertEqual(summary.top_speed_m_s, 2.0)
        self.assertEqual(summary.by_outcome, {Outcome.FLYING: 30, Outcome.BLOCKED: 6, Outcome.NOTHING_VERIFIED: 4,
                                              Outcome.OTHER: 1})
        self.assertAlmostEqual(summary.share(Outcome.BLOCKED), 6 / 41)
        self.assertAlmostEqual(summary.max_flown_risk, 30e-5)
        self.assertEqual(summary.unverified, 1)
        self.assertEqual(summary.words(), "4 m flown in 1.3 s, top speed 2.0 m/s. 73 % of 41 plans flying, 1 of them "
                                          "without a verified brake, risk 3.0e-04 at most.")

    def test_has_no_risk_where_nothing_flew(self):
        log, _ = self.logs()
        standing = write(self.folder / "s.log", [("NANOMAP_DECISIONS", START_US, decision(START_US, 0.0, BLOCKED))])
        summary = summarise(gather_flight(log, standing, Channels(), LIMITS))
        self.assertIsNone(summary.max_flown_risk)
        self.assertEqual(summary.words(), "4 m flown in 1.3 s, top speed 2.0 m/s. 0 % of 1 plans flying.")


class Candidates(unittest.TestCase):
    def test_are_each_in_one_layer(self):
        decisions = [decision(START_US + i, 0.0) for i in range(3)]
        layers = candidates_panel.layers(decisions)
        np.testing.assert_array_equal(sum(layer.counts for layer in layers), [10, 10, 10])
        self.assertEqual([(layer.label, layer.counts[0]) for layer in layers],
                         [("feasible", 1), ("obstacle too near", 3), ("hole", 2), ("outside the field of view", 1),
                          ("not evaluated", 3)])

    def test_have_a_veto_for_each_status(self):
        self.assertEqual(len(decision(0, 0.0).vetoes), len(Status))


class MapFrame(FlightTest):
    def test_holds_what_was_flown_and_decided_in_a_legible_shape(self):
        flight = self.flight()
        frame = flight_map_panel.frame(flight)
        for place in ([0, 0], [STEP_M * (FRAMES - 1), 0], [STEP_M * 29 + 2, 0]):
            self.assertTrue(frame.holds(np.array(place, dtype=float)), place)
        lowest, highest = flight_map_panel.HEIGHT_TO_WIDTH
        self.assertTrue(lowest <= frame.height_to_width <= highest + 1e-12)

    def test_holds_motions_without_a_brake(self):
        log, _ = self.logs()
        paper = decision(utime(FRAMES - 1), STEP_M * (FRAMES - 1))
        paper.has_brake = False
        frame = flight_map_panel.frame(gather_flight(log, write(
            self.folder / "d.log", [("NANOMAP_DECISIONS", paper.utime, paper)]), Channels(), LIMITS))
        from_start_to_motions_end = STEP_M * (FRAMES - 1) + 2
        self.assertAlmostEqual(frame.low[0] + frame.high[0], from_start_to_motions_end)

    def test_grows_where_it_would_be_a_strip(self):
        for end, size in (([10, 0], [12, 6]), ([0, 10], [6, 12]), ([0, 0], [2, 2]), ([3, 4], [5, 6])):
            frame = around(np.array([[0, 0], end]), 1.0, (0.5, 2.0))
            np.testing.assert_allclose(frame.high - frame.low, size)
            np.testing.assert_allclose(frame.low + frame.high, end)

    def test_tells_where_a_line_leaves_it(self):
        frame = Frame(np.array([-1.0, -2.0]), np.array([3.0, 2.0]))
        for start, towards, tip in (([0, 0], [30, 10], [3, 1]), ([0, 0], [0, -9], [0, -2]), ([1, 1], [-9, 1], [-1, 1])):
            np.testing.assert_allclose(frame.way_out(np.array(start, float), np.array(towards, float)), tip)

    def test_shows_fewer_decisions_of_a_long_flight(self):
        for duration_s, interval_s in ((0, 0.5), (30, 0.5), (31, 1.0), (100, 2.0)):
            messages = [("POSE_BODY", at, pose(at, 0.0)) for at in (0, 1_000_000 * duration_s + 1)]
            made = [("NANOMAP_DECISIONS", at, decision(at, 0.0)) for at in (0, 1_000_000 * duration_s)]
            log = write(self.folder / "long.log", [("CAMERA", 0, camera()), *messages, *made])
            self.assertEqual(flight_map_panel.interval_s(gather_flight(log, log, Channels(), LIMITS)), interval_s)

    def test_shows_decisions_and_outcomes(self):
        _, axes = plt.subplots()
        self.addCleanup(plt.close)
        flight = self.flight()
        flight_map_panel.draw(axes, flight, flight_map_panel.frame(flight))
        labels = [text.get_text() for text in axes.get_legend().get_texts()]
        self.assertEqual(labels[-3:], ["blocked", "nothing verified", "goal"])


class Latencies(FlightTest):
    def flight_with(self, healths: list[nanomap.health_t]) -> Flight:
        log = write(self.folder / "live.log", flight_inputs() + flight_decisions() +
                    [("NANOMAP_HEALTH", report.utime + CLOCKS_APART_US, report) for report in healths])
        return gather_flight(log, log, Channels(), LIMITS)

    def test_come_from_health_reports(self):
        flight = self.flight_with([health(utime(0), {"plan": (1e-3, 2e-3, 5e-3)}), health(utime(30), {})])
        self.assertEqual([report.utime for report in flight.healths], [utime(0), utime(30)])
        _, axes = plt.subplots()
        self.addCleanup(plt.close)
        latency_panel.draw(axes, flight)
        np.testing.assert_allclose([line.get_ydata() for line in axes.lines], [[1, np.nan], [5, np.nan]])
        self.assertEqual([text.get_text() for text in axes.get_legend().get_texts()], ["plan"])

    def test_are_drawn_if_there_are_any(self):
        self.assertEqual(self.flight().healths, [])
        with mock.patch.object(flight_picture.latency_panel, "draw") as drawn:
            flight_picture.draw(self.flight(), self.folder / "without.png")
            drawn.assert_not_called()
            flight_picture.draw(self.flight_with([health(utime(0), {})]), self.folder / "with.png")
            drawn.assert_called_once()


class FlightPicture(FlightTest, ProgramTest):
    def test_is_drawn_of_a_replay(self):
        log, decisions = self.logs()
        self.assert_draws(log, "--decisions", decisions)

    def test_is_drawn_of_the_flights_own_log(self):
        own = self.own_log()
        self.assert_draws(own, "--decisions", own)

    def test_is_drawn_of_a_vehicle_that_saw_and_decided_nothing(self):
        log = write(self.folder / "blind.log", [m for m in flight_inputs() if m[0] not in ("DEPTH", "GOAL")])
        alone = decision(utime(1), 0.0, "no depth image yet: standing still", risk=1.0)
        self.assert_draws(log, "--decisions", write(self.folder / "d.log", [("NANOMAP_DECISIONS", 1, alone)]))

    def test_is_not_drawn_of_a_moment_or_of_answers(self):
        log, decisions = self.logs()
        for wrong in (["--at", 1], [log]):
            result = self.run_report(log, "--decisions", decisions, "--out", self.folder / "p.png", *wrong)
            self.assertEqual(result.returncode, 2)
            self.assertRegex(result.stderr, "--at tells a moment|not allowed with|unrecognized")


if __name__ == "__main__":
    unittest.main()
