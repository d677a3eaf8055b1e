"""Tests of nanomap-report's reading of logs, and of its picture of a moment."""

import unittest

import nanomap
import numpy as np
from cases import ProgramTest, TemporaryFolderTest
from moment import gather
from nanomap_log import Channels, depth_counts, events, matrix, read_channels, read_told
from synthetic_log import FRAME_US, START_US, answers, camera, depth, pose, write, write_flight
from track import Track


class DepthCounts(unittest.TestCase):
    COUNTS = np.array([[0, 1, 256], [4660, 65535, 7]], dtype=np.uint16)

    def test_reads_both_compressions(self):
        for compression in (nanomap.depth_image_t.RAW, nanomap.depth_image_t.BLOSC):
            np.testing.assert_array_equal(depth_counts(depth(0, self.COUNTS, compression)), self.COUNTS)

    def test_names_wrong_size_and_unknown_compression(self):
        image = depth(0, self.COUNTS, nanomap.depth_image_t.RAW)
        image.width = 4
        with self.assertRaisesRegex(ValueError, "6 values for 4x2 px"):
            depth_counts(image)
        image.compression = 99
        with self.assertRaisesRegex(ValueError, "unknown compression 99"):
            depth_counts(image)


class Transforms(unittest.TestCase):
    def test_camera_looks_along_body_x(self):
        T_B_C = matrix(camera().body_from_camera)
        np.testing.assert_allclose(T_B_C @ [1, 2, 3, 1], [3, -1, -2, 1], atol=1e-15)


class Events(TemporaryFolderTest):
    def test_come_by_log_time_and_wanted_channel(self):
        log = write(self.folder / "a.log", [("P", 20, pose(2, 0)), ("Q", 15, pose(9, 0)), ("P", 10, pose(1, 0)),
                                            ("P", 12, camera())])
        self.assertEqual([event.message.utime for event in events(log, {"P": nanomap.body_pose_t})], [1, 2])

    def test_names_damaged_message(self):
        log = write(self.folder / "a.log", [("P", 77, pose(1, 0).encode()[:40])])
        with self.assertRaisesRegex(ValueError, "a.log: damaged body_pose_t at log time 77 us"):
            events(log, {"P": nanomap.body_pose_t})

    def test_names_missing_log(self):
        with self.assertRaisesRegex(ValueError, "no.log: no such log"):
            events(self.folder / "no.log", {})

    def test_channels_come_from_configuration(self):
        config = self.folder / "c.toml"
        config.write_text('[lcm]\npose_channel = "VIO"\ngoal_channel = "G"\n')
        self.assertEqual(read_channels(read_told(config)), Channels(pose_channel="VIO", goal_channel="G"))
        self.assertEqual(read_channels(read_told(None)), Channels())


class TrackTest(unittest.TestCase):
    def test_interpolates_between_poses_out_of_order_and_repeated(self):
        track = Track([pose(2_000_000, 2.0), pose(1_000_000, 1.0), pose(1_000_000, 1.0)])
        for utime, x_m in ((1_000_000, 1.0), (1_250_000, 1.25), (2_000_000, 2.0)):
            np.testing.assert_allclose(track.T_W_B(utime)[:3, 3], [x_m, 0, 1])
        self.assertFalse(track.covers(999_999))
        self.assertFalse(track.covers(2_000_001))

    def test_covers_nothing_without_poses(self):
        self.assertFalse(Track([]).covers(0))

    def test_measures_its_length(self):
        self.assertEqual(Track([]).length_m, 0)
        self.assertAlmostEqual(Track([pose(0, 1.0), pose(1, 3.0), pose(2, 2.0)]).length_m, 3.0)

    def test_takes_speeds_from_positions_where_none_is_told(self):
        poses = [pose(900_000 + i * 100_000, 0.5 * i) for i in range(4)]
        for unknown in poses[:3]:
            unknown.velocity = [np.nan] * 3
        poses[3].velocity = [3.0, 0.0, 4.0]
        np.testing.assert_allclose(Track(poses).speeds, [5, 5, 5, 5])


class Gather(TemporaryFolderTest):
    def test_takes_moment_with_deepest_answers(self):
        moment = gather(*write_flight(self.folder), Channels(), None)
        self.assertEqual(moment.answers.utime, START_US + 2 * FRAME_US)
        self.assertEqual([view.image.utime for view in moment.views],
                         [START_US + i * FRAME_US for i in (2, 1, 0)])
        np.testing.assert_allclose(moment.views[1].T_W_C[:3, 3], [0.1, 0, 1])
        self.assertEqual(moment.statistics.answers, 20)
        self.assertEqual(moment.statistics.flown.sum(), 5)
        self.assertEqual(moment.statistics.depths.tolist(), [1, 1, 1])

    def test_takes_moment_nearest_to_the_one_asked_for(self):
        moment = gather(*write_flight(self.folder), Channels(), 0.1)
        self.assertEqual(moment.answers.utime, START_US + 3 * FRAME_US)

    def test_leaves_out_views_of_another_epoch(self):
        log, answers_log = write_flight(self.folder)
        messages = [(e.channel, e.log_utime, e.message) for e in events(log, Channels().inputs())]
        for _, _, message in messages:
            if isinstance(message, nanomap.body_pose_t) and message.utime < START_US + 2 * FRAME_US:
                message.epoch = -1
        moment = gather(write(log, messages), answers_log, Channels(), None)
        self.assertEqual(len(moment.views), 1)

    def test_names_what_a_log_lacks(self):
        log, answers_log = write_flight(self.folder)
        empty = write(self.folder / "empty.log", [])
        with self.assertRaisesRegex(ValueError, "empty.log: holds nothing on the channels"):
            gather(empty, answers_log, Channels(), None)
        with self.assertRaisesRegex(ValueError, "empty.log: holds no answers"):
            gather(log, empty, Channels(), None)
        without_camera = write(self.folder / "blind.log", [("POSE_BODY", 1, pose(1, 0))])
        with self.assertRaisesRegex(ValueError, "blind.log: holds no camera model"):
            gather(without_camera, answers_log, Channels(), None)
        foreign = write(self.folder / "foreign.log", [("NANOMAP_ANSWERS", 1, answers(1, 0, [], 0, 0))])
        with self.assertRaisesRegex(ValueError, "Do the two belong together"):
            gather(log, foreign, Channels(), None)


class Program(ProgramTest):
    def test_writes_picture(self):
        self.assert_draws(*write_flight(self.folder))

    def test_names_missing_log_and_fails(self):
        result = self.run_report(self.folder / "no.log", self.folder / "no.log", "--out", self.folder / "p.png")
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, "nanomap-report: .*no.log: no such log")


if __name__ == "__main__":
    unittest.main()
