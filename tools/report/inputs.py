"""What a replay takes in, from its log."""

from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar

import nanomap
from nanomap_log import Channels, Event, events

US_PER_S = 1_000_000

Message = TypeVar("Message")


@dataclass(frozen=True)
class Inputs:
    log: Path
    events: list[Event]  # by log time, at least one

    def messages(self, message_type: type[Message]) -> list[Message]:
        return [event.message for event in self.events if isinstance(event.message, message_type)]

    def camera(self) -> nanomap.camera_model_t:
        """The last one told. Raises ValueError if there is none."""
        cameras = self.messages(nanomap.camera_model_t)
        if not cameras:
            raise ValueError(f"{self.log}: holds no camera model (nanomap.camera_model_t)")
        return cameras[-1]


def read_inputs(log: Path, channels: Channels) -> Inputs:
    """Raises ValueError naming the log if nothing is on the channels."""
    found = events(log, channels.inputs())
    if not found:
        raise ValueError(f"{log}: holds nothing on the channels {', '.join(channels.inputs())}")
    return Inputs(log, found)
