"""What a picture of one moment needs, gathered from a log and its answers."""

from dataclasses import dataclass
from pathlib import Path

import nanomap
import numpy as np
from nanomap_log import Status, events, matrix
from track import Track

US_PER_S = 1_000_000
CONTAINED = (Status.FREE, Status.OPEN)


@dataclass
class Statistics:
    """Of all answers of the log."""

    fan: np.ndarray  # answers by status
    flown: np.ndarray
    depths: np.ndarray  # view index of each answer that a view contained
    answers: int


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


def gather(log: Path, answers_log: Path, at_s: float | None) -> Moment:
    """The moment `at_s` after the log's first event, or, without it, the one where most points were answered by views
    that are not the newest: what a history is for.

    Raises ValueError naming the log that lacks something.
    """
    inputs = list(events(log))
    if not inputs:
        raise ValueError(f"{log}: holds no message that is known here")
    start = min(event.log_utime for event in inputs)
    statistics, chosen = _read_answers(answers_log, None if at_s is None else start + round(at_s * US_PER_S))
    answers = chosen.message

    cameras = _messages(inputs, nanomap.camera_model_t)
    if not cameras:
        raise ValueError(f"{log}: holds no camera model (nanomap.camera_model_t)")
    camera = cameras[-1]
    track = Track([pose for pose in _messages(inputs, nanomap.body_pose_t) if pose.epoch == answers.epoch])
    if not track.covers(answers.utime):
        raise ValueError(f"{log}: holds no pose at {answers.utime} us, the time of the answers. Do the two belong together?")

    T_B_C = matrix(camera.body_from_camera)
    images = {image.utime: image for image in _messages(inputs, nanomap.depth_image_t)}
    stamps = sorted((utime for utime in images if utime <= answers.utime), reverse=True)[:answers.num_views]
    views = [SeenView(images[utime], track.T_W_B(utime) @ T_B_C, (answers.utime - utime) / US_PER_S)
             for utime in stamps if track.covers(utime)]
    if not views:
        raise ValueError(f"{log}: holds no depth image with a pose before {answers.utime} us")
    return Moment(log, (chosen.log_utime - start) / US_PER_S, answers, camera, views, track, statistics)


def _messages(inputs, message_type: type) -> list:
    return [event.message for event in inputs if isinstance(event.message, message_type)]


def _read_answers(answers_log: Path, at_utime: int | None):
    statistics = Statistics(np.zeros(len(Status), int), np.zeros(len(Status), int), np.empty(0, int), 0)
    depths = []
    best, best_score = None, None
    for event in events(answers_log, nanomap.answers_t):
        message = event.message
        for i, answer in enumerate(message.answers):
            (statistics.fan if i < message.num_fan else statistics.flown)[answer.status] += 1
        deep = [a.view_index for a in message.answers if a.status in CONTAINED]
        depths.extend(deep)
        score = np.count_nonzero(deep) if at_utime is None else -abs(event.log_utime - at_utime)
        if best_score is None or score > best_score:
            best, best_score = event, score
    if best is None:
        raise ValueError(f"{answers_log}: holds no answers (nanomap.answers_t)")
    statistics.depths = np.array(depths, dtype=int)
    statistics.answers = int(statistics.fan.sum() + statistics.flown.sum())
    return statistics, best
