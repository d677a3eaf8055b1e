"""Tests of what nanomap-report says about how well a vehicle kept to its motions."""

import unittest
from pathlib import Path

import nanomap
import numpy as np
from cases import ProgramTest, TemporaryFolderTest
from limits import DeviationGrowth, TrackingAllowance, read_tracking_allowance
from nanomap_log import CONFIGURATION_CHANNEL, Channels, read_told
from outcomes import OUTCOMES, Outcome
from synthetic_log import START_US, decision, pose, trajectory, write
from tracking import TOLERANCE, Followed, gather_followed, strayed, words

SPEED_M_S = 2.0
DURATION_S = 6.0
POSE_US = 10_000
DECISION_US = 30_000
ALLOWANCE = TrackingAllowance(DeviationGrowth(0.05, 0.01, 0.02), DeviationGrowth(0.04, 0.0, 0.0), recovery_s=2.0)


def steady_decisions() -> list[nanomap.decision_t]:
    """Ahead at one speed: each begins where the one before is by then."""
    made = []
    for after_us in range(0, int(DURATION_S * 1e6), DECISION_US):
        message = decision(START_US + after_us, 0.0)
        message.flown = True
        message.brake = trajectory(message.utime, SPEED_M_S * after_us / 1e6, SPEED_M_S, [(3.0, 0.0)])
        made.append(message)
    return made


def poses(offset_m) -> list[nanomap.body_pose_t]:
    """Beside that motion by offset_m(seconds)."""
    made = []
    for after_us in range(0, int(DURATION_S * 1e6), POSE_US):
        message = pose(START_US + after_us, 0.0)
        moment_s = after_us / 1e6
        place = np.array([SPEED_M_S * moment_s, 0.0, 1.0]) + offset_m(moment_s)
        message.world_from_body.translation = list(place)
        made.append(message)
    return made


def channelled(decisions: list, where: list) -> list[tuple[str, int, object]]:
    return ([("NANOMAP_DECISIONS", message.utime, message) for message in decisions] +
            [("POSE_BODY", message.utime, message) for message in where])


def constant(*offset_m: float):
    return lambda _: np.array(offset_m)


def followed(offset_m) -> Followed:
    times_s = np.arange(0.0, DURATION_S, POSE_US / 1e6)
    return Followed(times_s, np.array([offset_m(time_s) for time_s in times_s]),
                    np.tile([SPEED_M_S, 0.0, 0.0], (len(times_s), 1)), np.ones(len(times_s)))


class Gathering(TemporaryFolderTest):
    def log(self, decisions: list, where: list) -> Path:
        return write(self.folder / "flight.log", channelled(decisions, where))

    def test_offsets_are_from_the_motion_in_force_at_each_pose(self):
        found = gather_followed(self.log(steady_decisions(), poses(constant(0.1, -0.2, 0.3))), Channels())
        self.assertEqual(len(found.times_s), DURATION_S * 1e6 / POSE_US)
        np.testing.assert_allclose(found.offsets_m, np.tile([0.1, -0.2, 0.3], (len(found.times_s), 1)), atol=1e-9)
        np.testing.assert_allclose(found.velocities_m_s, np.tile([SPEED_M_S, 0, 0], (len(found.times_s), 1)))

    def test_neither_other_hands_nor_other_worlds_nor_what_no_brake_was_verified_for_count(self):
        def in_other_hands(message):
            message.flown = False

        def without_brake(message):
            message.has_brake = False

        def of_another_world(message):
            message.epoch = 1

        for change in (in_other_hands, without_brake, of_another_world):
            with self.subTest(change.__name__):
                decisions = steady_decisions()
                for message in decisions[50:]:
                    change(message)
                found = gather_followed(self.log(decisions, poses(constant(0, 0, 0))), Channels())
                self.assertLess(found.times_s[-1], decisions[50].utime / 1e6)
                self.assertEqual(len(found.times_s), 150)

    def test_the_motion_before_counts_for_a_while_where_nothing_new_is_flown(self):
        def without_motion(message):
            message.has_motion = False

        def nothing_verified(message):
            message.has_brake = False
            message.reason = next(reason for reason, of in OUTCOMES.items() if of is Outcome.NOTHING_VERIFIED)

        for change in (without_motion, nothing_verified):
            with self.subTest(change.__name__):
                decisions = steady_decisions()
                for message in decisions[50:]:
                    change(message)
                found = gather_followed(self.log(decisions, poses(constant(0, 0, 0))), Channels())
                self.assertAlmostEqual(found.times_s[-1], decisions[49].utime / 1e6 + 0.2, places=2)

    def test_moments_across_an_interruption_are_no_pair(self):
        """Half a metre off in another world, or after other hands, is no straying."""
        def other_world(message):
            message.epoch = 1

        def in_other_hands(message):
            message.flown = False

        for change, until in ((other_world, None), (in_other_hands, 52)):
            with self.subTest(change.__name__):
                decisions = steady_decisions()
                for message in decisions[50:until]:
                    change(message)
                where = poses(lambda moment_s: np.array([0.0, 0.5 if moment_s >= 1.5 else 0.0, 0.0]))
                if until is None:
                    for message in where[150:]:
                        message.epoch = 1
                found = gather_followed(self.log(decisions, where), Channels())
                self.assertEqual(len(set(found.runs)), 2)
                self.assertAlmostEqual(strayed(found, 0.2, ALLOWANCE).horizontal_m, 0.05 / np.sqrt(2), delta=0.005)

    def test_a_log_without_any_is_refused_by_name(self):
        for decisions, where, why in (([], poses(constant(0, 0, 0)), "holds no decisions that were flown"),
                                      (steady_decisions(), [], "holds no poses .* from when")):
            with self.assertRaisesRegex(ValueError, f"flight.log: {why}"):
                gather_followed(self.log(decisions, where), Channels())


class Straying(unittest.TestCase):
    def test_a_vehicle_that_comes_back_as_it_is_taken_to_does_not_stray(self):
        returns = followed(lambda moment_s: np.array([0.3 * max(0.0, 1.0 - moment_s / 2.0), 0.0, 0.0]))
        for rows, ahead_s in (([0, 50], 0.5), ([0, 150], 1.5), (slice(200, None), 1.0)):
            part = Followed(returns.times_s[rows], returns.offsets_m[rows], returns.velocities_m_s[rows],
                            returns.runs[rows])
            self.assertAlmostEqual(strayed(part, ahead_s, ALLOWANCE).horizontal_m, 0.0, places=9)

    def test_a_lasting_offset_is_what_should_have_been_returned(self):
        found = followed(constant(0.2, 0.0, -0.4))
        row = strayed(found, 1.0, ALLOWANCE)
        self.assertAlmostEqual(row.horizontal_m, 0.1 / np.sqrt(2))
        self.assertAlmostEqual(row.vertical_m, 0.2)
        self.assertAlmostEqual(strayed(found, 2.0, ALLOWANCE).vertical_m, 0.4)

    def test_allowed_is_the_growth_and_a_quarter_of_the_return(self):
        row = strayed(followed(constant(0.4, 0.0, 0.0)), 1.0, ALLOWANCE)
        grown_m = 0.05 + 0.01 * SPEED_M_S + 0.02
        self.assertAlmostEqual(row.horizontal_allowed_m, np.sqrt((grown_m**2 + 0.05**2 + grown_m**2) / 2))
        self.assertAlmostEqual(row.vertical_allowed_m, 0.04)

    def test_without_recovery_the_vehicle_is_taken_to_be_on_its_motion(self):
        nowhere_else = TrackingAllowance(ALLOWANCE.horizontal, ALLOWANCE.vertical, recovery_s=0.0)
        row = strayed(followed(constant(0.0, 0.0, 0.4)), 0.2, nowhere_else)
        self.assertAlmostEqual(row.vertical_m, 0.4)
        self.assertAlmostEqual(row.vertical_allowed_m, 0.04)

    def test_share_beyond_three_of_what_is_allowed(self):
        """Thrown off by half a metre upwards for the last tenth of the time: beyond on one axis of three."""
        row = strayed(followed(lambda moment_s: np.array([0.0, 0.0, 0.5 if moment_s >= 5.4 else 0.0])), 0.5, ALLOWANCE)
        self.assertAlmostEqual(row.beyond_three, 50 / 550 / 3, places=3)
        self.assertFalse(row.is_covered)

    def test_rare_large_ones_are_not_covered_though_the_mean_square_is(self):
        row = strayed(followed(lambda moment_s: np.array([0.0, 0.0, 0.13 if moment_s % 1.0 < 0.05 else 0.0])), 0.5,
                      ALLOWANCE)
        self.assertLess(row.vertical_m, TOLERANCE * row.vertical_allowed_m)
        self.assertGreater(row.beyond_three, 0.01)
        self.assertFalse(row.is_covered)

    def test_poses_of_any_rate_pair(self):
        slow = followed(constant(0.0, 0.2, 0.0))
        slow = Followed(slow.times_s[::7], slow.offsets_m[::7], slow.velocities_m_s[::7], slow.runs[::7])
        self.assertTrue(all(strayed(slow, ahead_s, ALLOWANCE) for ahead_s in (0.2, 0.5, 1.0, 1.5, 2.0)))

    def test_none_where_the_flight_is_shorter(self):
        self.assertIsNone(strayed(followed(constant(0, 0, 0)), 2 * DURATION_S, ALLOWANCE))


class Words(unittest.TestCase):
    def test_say_how_far_and_on_which_side(self):
        self.assertIn("0.100 m behind in the mean", words(followed(constant(-0.1, 0.0, 0.0)), ALLOWANCE, "x"))
        self.assertIn("0.100 m ahead in the mean", words(followed(constant(0.1, 0.0, 0.0)), ALLOWANCE, "x"))
        said = words(followed(constant(0.3, 0.4, 0.2)), ALLOWANCE, "the defaults")
        self.assertIn("by the defaults:", said)
        self.assertIn("0.500 m horizontally, 0.200 m vertically", said)

    def test_name_what_to_change_only_where_less_is_allowed(self):
        self.assertNotIn("[risk]", words(followed(constant(0.0, 0.0, 0.0)), ALLOWANCE, "x"))
        self.assertIn("raise [risk] horizontal_*", words(followed(constant(0.0, 0.4, 0.0)), ALLOWANCE, "x"))


class Allowance(TemporaryFolderTest):
    def test_is_the_configurations_or_the_default(self):
        config = self.folder / "vehicle.toml"
        config.write_text("[risk]\nhorizontal_base_m = 0.5\n[tracking]\nrecovery_s = 3.0\n")
        told, default = read_tracking_allowance(read_told(config)), read_tracking_allowance({})
        self.assertEqual((told.horizontal.base_m, told.recovery_s), (0.5, 3.0))
        self.assertEqual((told.horizontal.per_time_m_s, told.vertical),
                         (default.horizontal.per_time_m_s, default.vertical))
        self.assertGreater(default.recovery_s, 0.0)


class Program(ProgramTest):
    def test_prints_them_and_draws_nothing(self):
        log = write(self.folder / "flight.log", channelled(steady_decisions(), poses(constant(0.1, 0.0, 0.0))))
        result = self.run_report(log, "--tracking")
        self.assertEqual((result.returncode, result.stderr), (0, ""))
        self.assertIn("0.100 m ahead in the mean", result.stdout)
        self.assertRegex(result.stdout, r"2\.0 s +0\.071 of 0\.1\d\d ")

    def test_allows_by_what_the_flight_was_recorded_with_unless_told_otherwise(self):
        recorded = nanomap.text_t()
        recorded.utime, recorded.text = START_US, "[risk]\nhorizontal_base_m = 5.0\n"
        told = channelled(steady_decisions(), poses(constant(0.1, 0.0, 0.0)))
        log = write(self.folder / "flight.log", [(CONFIGURATION_CHANNEL, START_US, recorded), *told])
        said = self.run_report(log, "--tracking").stdout
        self.assertIn("by the configuration it was recorded with:", said)
        self.assertRegex(said, r"0\.5 s +0\.\d{3} of 5\.")
        config = self.folder / "vehicle.toml"
        config.write_text("[risk]\nhorizontal_base_m = 7.0\n")
        said = self.run_report(log, "--tracking", "--config", config).stdout
        self.assertIn(f"by {config}:", said)
        self.assertRegex(said, r"0\.5 s +0\.\d{3} of 7\.")

    def test_a_flight_too_short_is_refused(self):
        log = write(self.folder / "flight.log", channelled(steady_decisions()[:3], poses(constant(0.1, 0.0, 0.0))[:9]))
        result = self.run_report(log, "--tracking")
        self.assertEqual(result.returncode, 1)
        self.assertIn("no two poses of one flight", result.stderr)

    def test_refuses_what_does_not_go_together(self):
        log = write(self.folder / "flight.log", channelled(steady_decisions(), []))
        for wrong, why in ((["--tracking", "--out", self.folder / "p.png"], "--tracking draws no picture"),
                           (["--tracking", "--at", 1], "--at tells a moment"),
                           (["--decisions", log], "--out is missing")):
            result = self.run_report(log, *wrong)
            self.assertEqual(result.returncode, 2)
            self.assertIn(why, result.stderr)


if __name__ == "__main__":
    unittest.main()
