"""The oracle: checks the answers that nanomap-replay gave to a log, and that the check would have seen faults."""

from dataclasses import dataclass
from pathlib import Path

import nanomap
from chain import Chain
from compare import Tally, compare
from mutations import MUTATIONS, mutants
from nanomap_log import events, read_channels, read_told
from settings import read_settings
from view import Camera, View

# A point within rounding of a limit may rightly go either way; more than a few are a systematic difference.
AMBIGUOUS_FEW = 3
AMBIGUOUS_SHARE = 1e-3


@dataclass(frozen=True)
class Sample:
    """Which of the answers are compared: brute force over all of them takes hours."""

    message_stride: int
    answer_stride: int


@dataclass(frozen=True)
class Outcome:
    tally: Tally
    unseen_mutations: list[str]
    corrections: int

    def faults(self) -> list[str]:
        """What speaks against the module, or against the check itself; empty if all is well."""
        tally = self.tally
        faults = list(tally.mismatches)
        if tally.ambiguous > AMBIGUOUS_FEW + AMBIGUOUS_SHARE * tally.answers:
            faults.append(f"{tally.ambiguous} of {tally.answers} answers hang on rounding: too many for chance")
        if tally.answers == 0:
            faults.append("no answer was compared")
        if tally.deepest_view == 0:
            faults.append("no compared answer comes from behind the newest view: the chain was not tried")
        faults += [f"the check is blind to: {name}" for name in self.unseen_mutations]
        return faults


def check(log: Path, answers: Path, config: Path, overrides: list[str], sample: Sample) -> Outcome:
    """Replays `log` step by step, by log time. An answers message follows each input that let a view into the chain.

    Raises ValueError if the answers do not follow the inputs.
    """
    chain = Chain(read_settings(config, overrides))
    cameras: dict[str, Camera] = {}
    tally = Tally()
    unseen: list[str] | None = None
    channels = read_channels(read_told(config))
    told = (event.message for event in events(answers, channels.answers()))
    count = 0
    for event in events(log, channels.inputs()):
        if not feed(chain, cameras, event.message):
            continue
        message = next(told, None)
        if message is None:
            raise ValueError(f"{answers}: ends before the input at log time {event.log_utime} us")
        if count % sample.message_stride == 0:
            faults_before = len(tally.mismatches)
            compare(message, chain, tally, sample.answer_stride)
            if unseen is None and len(tally.mismatches) == faults_before:
                unseen = _unseen_mutations(message, chain)
        count += 1
    if next(told, None) is not None:
        raise ValueError(f"{answers}: goes on behind the log's end")
    return Outcome(tally, list(MUTATIONS) if unseen is None else unseen, chain.corrections)


def feed(chain: Chain, cameras: dict[str, Camera], message) -> int:
    """Returns how many views the message let into the chain."""
    match message:
        case nanomap.camera_model_t():
            cameras[message.name] = Camera(message)
        case nanomap.body_pose_t():
            return chain.add_pose(message)
        case nanomap.pose_correction_t():
            chain.add_correction(message)
        case nanomap.depth_image_t():
            return chain.add_view(View(message, cameras[message.camera], chain.settings))
    return 0


def _unseen_mutations(message, chain: Chain) -> list[str] | None:
    """Faults that the comparison misses; None if this message cannot carry them."""
    unseen = None
    for name, mutant in mutants(message):
        tally = Tally()
        compare(mutant, chain, tally, stride=1)
        unseen = (unseen or []) + ([] if tally.mismatches else [name])
    return unseen
