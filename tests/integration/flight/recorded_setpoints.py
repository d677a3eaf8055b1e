"""Judges the setpoints of a recorded flight by the decisions that they were sampled from."""

from pathlib import Path

import nanomap
from nanomap_log import Channels, events

US_PER_S = 1_000_000
MAX_DECISION_AGE_S = 0.2
STOP_MARGIN_S = 2.0  # safety.stop_margin_s
SETPOINTS_CHANNEL = "NANOMAP_SETPOINTS"


def stale_setpoints(recordings: Path) -> list[str]:
    """Those that no decision, or neither a fresh one nor one whose brake was still to be flown, stands behind.

    Raises ValueError if nothing was recorded that a decision was flown in.
    """
    channels = Channels()
    decisions = {event.message.sequence: event.message
                 for event in events(recordings, {channels.decisions_channel: nanomap.decision_t})}
    setpoints = [event.message for event in events(recordings, {SETPOINTS_CHANNEL: nanomap.setpoint_t})
                 if event.message.has_decision]
    if not setpoints:
        raise ValueError(f"{recordings}: no setpoint was sampled from a decision")
    found = []
    for setpoint in setpoints:
        decision = decisions.get(setpoint.decision_sequence)
        if decision is None:
            found.append(f"decision {setpoint.decision_sequence} of the setpoint at {setpoint.utime} is not recorded")
            continue
        age_s = (setpoint.utime - decision.utime) / US_PER_S
        brake_end = decision.brake.utime + sum(decision.brake.piece_duration) * US_PER_S
        past_end_s = (setpoint.utime - brake_end) / US_PER_S
        if age_s > MAX_DECISION_AGE_S and past_end_s > STOP_MARGIN_S:
            found.append(f"the setpoint at {setpoint.utime} is of a decision that is {age_s:.3f} s old, "
                         f"{past_end_s:.3f} s after its brake's end")
    return found
