"""What a picture of a whole flight with its decisions needs, gathered from their logs."""

from collections import Counter
from dataclasses import dataclass
from pathlib import Path

import nanomap
import numpy as np
from inputs import US_PER_S, Inputs, read_inputs
from limits import Limits
from nanomap_log import Channels, Event, events
from seen_points import SeenPoints, gather_seen_points
from track import Track


@dataclass(frozen=True)
class Flight:
    log: Path
    decisions: list[nanomap.decision_t]  # by time, at least one
    own: bool  # the decisions are those of the flight itself, not of a replay
    tracks: dict[int, Track]  # by epoch
    epoch: int  # of most decisions: the world that is drawn
    goals: list[nanomap.goal_t]  # of that world, that decisions were made for
    seen: SeenPoints  # in that world
    limits: Limits
    healths: list[nanomap.health_t]  # by time; none without a flight process
    start_utime: int  # the log's first event, on the messages' clock

    @property
    def track(self) -> Track:
        return self.tracks[self.epoch]

    def seconds(self, utimes) -> np.ndarray:
        """After the log's first event, as nanomap-replay counts them."""
        return (np.asarray(utimes, dtype=np.int64) - self.start_utime) / US_PER_S

    @property
    def decision_seconds(self) -> np.ndarray:
        return self.seconds([decision.utime for decision in self.decisions])

    def utime_range(self) -> tuple[int, int]:
        """Of the first pose and of the last, in any world."""
        tracks = self.tracks.values()
        return min(t.utimes[0] for t in tracks), max(t.utimes[-1] for t in tracks)

    def drawn_decisions(self) -> list[nanomap.decision_t]:
        """Those made in the world that is drawn, at times when the vehicle's place is known."""
        return [d for d in self.decisions if d.epoch == self.epoch and self.track.covers(d.utime)]


def gather_flight(log: Path, decisions_log: Path, channels: Channels, limits: Limits) -> Flight:
    """The two may be the same log. Raises ValueError naming the log that lacks something."""
    inputs = read_inputs(log, channels)
    decided = events(decisions_log, channels.decisions())
    if not decided:
        raise ValueError(f"{decisions_log}: holds no decisions on the channel {channels.decisions_channel}: "
                         "nanomap-replay LOG --decisions writes such a log")
    decisions = [event.message for event in decided]
    tracks = _tracks(inputs)
    epoch = Counter(decision.epoch for decision in decisions).most_common(1)[0][0]
    track = tracks.get(epoch, Track([]))
    if len(track.utimes) < 2 or not any(d.epoch == epoch and track.covers(d.utime) for d in decisions):
        raise ValueError(f"{log}: holds no poses of epoch {epoch} around the decisions in {decisions_log}. "
                         "Do the two belong together?")
    seen = gather_seen_points(inputs.messages(nanomap.depth_image_t), inputs.camera(), track)
    return Flight(log, decisions, log.samefile(decisions_log), tracks, epoch,
                  _goals(log, channels, decisions, epoch), seen, limits,
                  [event.message for event in events(log, channels.healths())], _start_utime(inputs, decided))


def _tracks(inputs: Inputs) -> dict[int, Track]:
    poses: dict[int, list] = {}
    for pose in inputs.messages(nanomap.body_pose_t):
        poses.setdefault(pose.epoch, []).append(pose)
    return {epoch: Track(of_epoch) for epoch, of_epoch in poses.items()}


def _goals(log: Path, channels: Channels, decisions: list, epoch: int) -> list[nanomap.goal_t]:
    used = {decision.goal_sequence for decision in decisions if decision.has_goal and decision.epoch == epoch}
    told = [event.message for event in events(log, channels.goals())]
    return [goal for goal in told if goal.sequence in used and goal.epoch == epoch]


def _start_utime(inputs: Inputs, decided: list[Event]) -> int:
    """The log's clock may be another than the messages': their usual difference is taken out."""
    return inputs.events[0].log_utime - int(np.median([event.log_utime - event.message.utime for event in decided]))
