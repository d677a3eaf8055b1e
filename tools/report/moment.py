"""What a picture of one moment needs, gathered from a log and its answers."""

from dataclasses import dataclass
from pathlib import Path

import nanomap
import numpy as np
from inputs import US_PER_S, read_inputs
from nanomap_log import Channels, Event, Status, events, matrix
from track import Track

CONTAINED = (Status.FREE, Status.OPEN)


@dataclass(frozen=True)
class Statistics:
    """Of all answers of the log."""

    fan: np.ndarray  # answers by status
    flown: np.ndarray
    depths: np.ndarray  # view index of each answer that a view contained

    @property
    def answers(self) -> int:
        return int(self.fan.sum() + self.flown.sum())


@dataclass(frozen=True)
class SeenView:
    """A view of the history, with where its camera was."""

    image: nanomap.depth_image_t
    T_W_C: np.ndarray
    age_s: float


@dataclass(frozen=True)
class Moment:
    log: Path
    seconds: float  # after the log's first event
    answers: nanomap.answers_t
    camera: nanomap.camera_model_t
    views: list[SeenView]  # newest first; those of another epoch are left out
    track: Track
    statistics: Statistics

    def T_W_C(self, answer: nanomap.answer_t) -> np.ndarray | None:
        """The camera of the view that answers."""
        return next((view.T_W_C for view in self.views if view.image.utime == answer.view_utime), None)


def gather(log: Path, answers_log: Path, channels: Channels, at_s: float | None) -> Moment:
    """The moment `at_s` after the log's first event, or, without it, the one where most points were answered by views
    that are not the newest: what a history is for. It has some of the path flown next in it, if any moment has.

    Raises ValueError naming the log that lacks something.
    """
    inputs = read_inputs(log, channels)
    start = inputs.events[0].log_utime
    replies = events(answers_log, channels.answers())
    if not replies:
        raise ValueError(f"{answers_log}: holds no answers on the channel {channels.answers_channel}")
    chosen = _choose(replies, None if at_s is None else start + round(at_s * US_PER_S))
    answers = chosen.message

    camera = inputs.camera()
    track = Track([pose for pose in inputs.messages(nanomap.body_pose_t) if pose.epoch == answers.epoch])
    if not track.covers(answers.utime):
        raise ValueError(f"{log}: holds no pose at {answers.utime} us, the time of the answers in {answers_log}. "
                         "Do the two belong together?")

    T_B_C = matrix(camera.body_from_camera)
    images = {image.utime: image for image in inputs.messages(nanomap.depth_image_t)}
    stamps = sorted((utime for utime in images if utime <= answers.utime), reverse=True)[:answers.num_views]
    views = [SeenView(images[utime], track.T_W_B(utime) @ T_B_C, (answers.utime - utime) / US_PER_S)
             for utime in stamps if track.covers(utime)]
    if not views:
        raise ValueError(f"{log}: holds no depth image with a pose before {answers.utime} us")
    return Moment(log, (chosen.log_utime - start) / US_PER_S, answers, camera, views, track, _count(replies))


def _choose(replies: list[Event], at_utime: int | None) -> Event:
    if at_utime is not None:
        return min(replies, key=lambda event: abs(event.log_utime - at_utime))
    longest = max(_flown_points(event.message) for event in replies)
    with_path = [event for event in replies if 2 * _flown_points(event.message) >= longest]
    return max(with_path, key=lambda event: np.count_nonzero(_depths(event.message)))


def _flown_points(message: nanomap.answers_t) -> int:
    return len(message.answers) - message.num_fan


def _depths(message: nanomap.answers_t) -> list[int]:
    """How many views back the points were answered that a view contained."""
    return [answer.view_index for answer in message.answers if answer.status in CONTAINED]


def _count(replies: list[Event]) -> Statistics:
    fan, flown, depths = np.zeros(len(Status), int), np.zeros(len(Status), int), []
    for event in replies:
        for i, answer in enumerate(event.message.answers):
            (fan if i < event.message.num_fan else flown)[answer.status] += 1
        depths.extend(_depths(event.message))
    return Statistics(fan, flown, np.array(depths, dtype=int))
