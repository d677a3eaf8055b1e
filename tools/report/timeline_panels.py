"""What was flown and decided, over time."""

import matplotlib.pyplot as plt
import numpy as np
from flight import Flight
from flight_summary import Summary
from motion import Motion
from outcomes import Outcome, outcome
from style import BRAKE_COLOUR, MOTION_COLOUR, legend_on_title_line

# How far ahead of a plan its motion is told: later ones have replaced it by then.
AHEAD_S = 0.5
# Risks below are as good as none.
LEAST_RISK = 1e-9
RISK_TICKS = [LEAST_RISK, 1e-6, 1e-3, 1], [r"$\leq 10^{-9}$", "$10^{-6}$", "$10^{-3}$", "1"]
# A decision holds until the next one, but not longer than some periods of planning.
HOLDS_PERIODS = 3
LEAST_LANES = 3  # one alone would be a wall
# Beyond, an obstacle is of no interest to the eye.
SHOWN_CLEARANCE_M = 5.0


def draw_outcomes(axes: plt.Axes, flight: Flight, summary: Summary) -> None:
    """A lane for each outcome that there was."""
    starts = flight.decision_seconds
    periods = np.diff(starts)
    period = float(np.median(periods)) if len(periods) else 0.0
    lengths = np.minimum(np.append(periods, period), HOLDS_PERIODS * period)
    kinds = [kind for kind in Outcome if summary.by_outcome[kind]]
    for lane, kind in enumerate(kinds):
        spans = [span for span, d in zip(zip(starts, lengths), flight.decisions) if outcome(d) is kind]
        axes.broken_barh(spans, (lane - 0.4, 0.8), color=kind.value.colour, linewidth=0.5)
    axes.set_yticks(range(len(kinds)), [f"{kind.value.label}, {100 * summary.share(kind):.0f} %" for kind in kinds])
    axes.set_ylim(max(len(kinds), LEAST_LANES) - 0.5, -0.5)
    axes.tick_params(axis="y", length=0)
    axes.set_title("What was decided")


def draw_speeds(axes: plt.Axes, flight: Flight) -> None:
    for track in flight.tracks.values():
        axes.plot(flight.seconds(track.utimes), track.speeds, color="#0072B2", linewidth=2.0,
                  label="vehicle" if track is flight.track else None)
    ahead = [_speed_ahead(d) if d.has_motion else np.nan for d in flight.decisions]
    axes.plot(flight.decision_seconds, ahead, color=MOTION_COLOUR, linewidth=0.9,
              label=f"chosen, {AHEAD_S:g} s later")
    for i, limit in enumerate(sorted({goal.top_speed for goal in flight.goals})):
        axes.axhline(limit, color="#CC79A7", linestyle="--", linewidth=1.4, label=None if i else "soft top speed")
    axes.set_ylim(bottom=0)
    axes.set_ylabel("speed [m/s]")
    axes.set_title("Speed")
    legend_on_title_line(axes)


def draw_clearance(axes: plt.Axes, flight: Flight) -> None:
    decisions = flight.drawn_decisions()
    clearances = [flight.seen.clearance(flight.track, d.utime) for d in decisions]
    axes.plot(flight.seconds([d.utime for d in decisions]), clearances, color="#0072B2", linewidth=1.4)
    axes.axhspan(0, flight.limits.vehicle_radius_m, color="#D55E00", alpha=0.25, linewidth=0, label="vehicle's radius")
    farthest = max((c for c in clearances if np.isfinite(c)), default=SHOWN_CLEARANCE_M)
    axes.set_ylim(0, min(SHOWN_CLEARANCE_M, 1.1 * farthest))
    axes.set_ylabel("from centre [m]")
    axes.set_title("Nearest measured point")
    legend_on_title_line(axes)


def draw_risks(axes: plt.Axes, flight: Flight) -> None:
    """Of what was chosen; a risk of less than what is drawn lies on the lower edge."""
    decisions = flight.decisions
    motions = [d.risk if d.has_motion else np.nan for d in decisions]
    brakes = [d.brake_risk if d.has_brake else np.nan for d in decisions]
    for label, risks, colour, marker in (("motion", motions, MOTION_COLOUR, "."),
                                         ("its brake", brakes, BRAKE_COLOUR, "x")):
        axes.plot(flight.decision_seconds, np.maximum(risks, LEAST_RISK), linestyle="", color=colour, marker=marker,
                  markersize=4, label=label, clip_on=False)
    axes.axhline(flight.limits.max_risk, color="#0072B2", linestyle="--", linewidth=1.6,
                 label=f"constraint, {flight.limits.max_risk:g}")
    axes.set_yscale("log")
    axes.set_ylim(LEAST_RISK, 3)
    axes.set_yticks(*RISK_TICKS)
    axes.set_ylabel("collision probability")
    axes.set_title("Risk")
    legend_on_title_line(axes)


def _speed_ahead(decision) -> float:
    return float(np.linalg.norm(Motion(decision.trajectory).at(np.array([AHEAD_S])).velocity[0]))
