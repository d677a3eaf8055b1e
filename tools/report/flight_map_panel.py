"""A whole flight from above, in the estimator's world W: what was seen, flown and decided."""

import math

import matplotlib.pyplot as plt
import numpy as np
from flight import Flight
from inputs import US_PER_S
from map_frame import Frame, around
from matplotlib import patheffects
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap
from matplotlib.lines import Line2D
from motion import Motion
from outcomes import Outcome, outcome
from style import BRAKE_COLOUR, HEIGHT_BAND_M, MOTION_COLOUR

# Decisions are drawn this often, or, on a long flight, at the multiple of it that draws no more than so many.
DECISION_EVERY_S = 0.5
MOST_DECISIONS = 60
CURVE_STEP_M = 0.1
CELLS_ACROSS = 550  # of the longer side: what a picture of this width can show
MARGIN_M = 4.0
HEIGHT_TO_WIDTH = (0.15, 0.45)
SEEN_COLOURS = ListedColormap(plt.get_cmap("Greys")(np.linspace(0.15, 0.75, 256))).with_extremes(bad="none")
SPEED_COLOURS = "viridis"


def frame(flight: Flight) -> Frame:
    """All that was flown and decided, with its surroundings."""
    decisions = _meant_to_be_flown(flight)
    curves = [_curve(motion) for d in decisions
              for motion in ([d.trajectory, d.brake] if d.has_brake else [d.trajectory])]
    return around(np.vstack([flight.track.positions[:, :2], *curves]), MARGIN_M, HEIGHT_TO_WIDTH)


def draw(axes: plt.Axes, flight: Flight, shown: Frame) -> None:
    axes.set_aspect("equal")
    axes.set_xlim(shown.low[0], shown.high[0])
    axes.set_ylim(shown.low[1], shown.high[1])
    axes.set_xlabel("x of W [m]")
    axes.set_ylabel("y of W [m]")
    _draw_seen(axes, flight, shown)
    _draw_path(axes, flight)
    handles = [*_draw_decisions(axes, flight), *_draw_outcomes(axes, flight), *_draw_goals(axes, flight, shown)]
    axes.legend(handles=handles, loc="lower center", bbox_to_anchor=(0.5, 1), ncols=max(3, (len(handles) + 1) // 2),
                columnspacing=1.6, handlelength=1.6)


def _draw_seen(axes: plt.Axes, flight: Flight, shown: Frame) -> None:
    """The darker, the more often measured."""
    low, high = shown.low, shown.high
    points = flight.seen.positions[np.abs(flight.seen.heights) < HEIGHT_BAND_M]
    cells = np.ceil(CELLS_ACROSS * (high - low) / (high - low).max()).astype(int)
    counts, _, _ = np.histogram2d(points[:, 0], points[:, 1], bins=cells, range=np.column_stack([low, high]))
    axes.imshow(np.ma.log(np.ma.masked_equal(counts.T, 0)), extent=(low[0], high[0], low[1], high[1]), origin="lower",
                cmap=SEEN_COLOURS, interpolation="nearest", zorder=1)


def interval_s(flight: Flight) -> float:
    """Between decisions that are drawn."""
    drawn = flight.drawn_decisions()
    duration_s = (drawn[-1].utime - drawn[0].utime) / US_PER_S
    return DECISION_EVERY_S * max(1, math.ceil(duration_s / (MOST_DECISIONS * DECISION_EVERY_S)))


def _at_intervals(flight: Flight, decisions: list) -> list:
    """The first, and each that comes an interval after the one before."""
    interval_us = interval_s(flight) * US_PER_S
    chosen = []
    for decision in decisions:
        if not chosen or decision.utime - chosen[-1].utime >= interval_us:
            chosen.append(decision)
    return chosen


def _meant_to_be_flown(flight: Flight) -> list:
    """Without a brake too: the configuration may do without (stop_check = "paper")."""
    return _at_intervals(flight, [d for d in flight.drawn_decisions() if d.has_brake or outcome(d) is Outcome.FLYING])


def _curve(trajectory) -> np.ndarray:
    motion = Motion(trajectory)
    return motion.at(motion.dense_times(CURVE_STEP_M)).position[:, :2]


def _draw_decisions(axes: plt.Axes, flight: Flight) -> list[Line2D]:
    decisions = _meant_to_be_flown(flight)
    axes.add_collection(LineCollection([_curve(d.trajectory) for d in decisions], colors=MOTION_COLOUR, linewidths=1.0,
                                       zorder=4))
    brakes = [_curve(d.brake) for d in decisions if d.has_brake]
    axes.add_collection(LineCollection(brakes, colors=BRAKE_COLOUR, linewidths=1.5, zorder=5))
    ends = np.array([brake[-1] for brake in brakes]).reshape(-1, 2)
    axes.scatter(*ends.T, s=14, color=BRAKE_COLOUR, edgecolors="white", linewidths=0.5, zorder=5)
    return [
        Line2D([], [], color="#8A8A8A", linestyle="", marker="s", markersize=6,
               label=f"measured, within {HEIGHT_BAND_M:g} m of the vehicle's height"),
        Line2D([], [], color=MOTION_COLOUR, linewidth=1.2, label=f"motion chosen, every {interval_s(flight):g} s"),
        Line2D([], [], color=BRAKE_COLOUR, linewidth=1.8, marker="o", markersize=4,
               label="verified brake, to its standstill"),
    ]


def _draw_path(axes: plt.Axes, flight: Flight) -> None:
    track = flight.track
    path = track.positions[:, :2]
    line = LineCollection(np.stack([path[:-1], path[1:]], axis=1), cmap=SPEED_COLOURS, linewidths=6, zorder=3,
                          capstyle="round", path_effects=[patheffects.Stroke(linewidth=8, foreground="white"),
                                                          patheffects.Normal()])
    line.set_array(track.speeds[1:])
    line.set_clim(0, max(np.nanmax(track.speeds), 1.0))
    axes.add_collection(line)
    bar = axes.figure.colorbar(line, cax=axes.inset_axes((1.01, 0, 0.012, 1)))
    bar.set_label("speed flown [m/s]")
    _tell(axes, "start", path[0], (0, -10), ha="center", va="top")


def _draw_outcomes(axes: plt.Axes, flight: Flight) -> list[Line2D]:
    """Where the vehicle did not fly on, and why."""
    handles = []
    for kind in Outcome:
        look = kind.value
        here = _at_intervals(flight, [d for d in flight.drawn_decisions() if outcome(d) is kind])
        if not look.marker or not here:
            continue
        places = np.array([flight.track.T_W_B(d.utime)[:2, 3] for d in here])
        axes.scatter(*places.T, s=46, marker=look.marker, color=look.colour, edgecolors="white", linewidths=0.8,
                     zorder=7)
        handles.append(Line2D([], [], linestyle="", marker=look.marker, markersize=8, color=look.colour,
                              markeredgecolor="white", markeredgewidth=0.8, label=look.label))
    return handles


def _draw_goals(axes: plt.Axes, flight: Flight, shown: Frame) -> list[Line2D]:
    """One that is outside the picture as an arrow towards it."""
    last = flight.track.positions[-1, :2]
    goals = [np.array(place) for place in {tuple(goal.position[:2]) for goal in flight.goals}]
    inside = [goal for goal in goals if shown.holds(goal)]
    for goal in goals:
        if shown.holds(goal):
            continue
        tip = shown.way_out(last, goal)
        right, up = goal > last
        alignment = {"ha": "right" if right else "left", "va": "top" if up else "bottom"}
        # The words stand beside the arrow: above it or below, or, if it is steep, farther from its tip.
        steep = 2 * abs(goal[1] - last[1]) > abs(goal[0] - last[0])
        beside_pt = 60 if steep else 8
        axes.annotate("", tip, xytext=(last + tip) / 2, zorder=8, arrowprops={"arrowstyle": "-|>", "linewidth": 2})
        _tell(axes, f"goal, {np.linalg.norm(goal - last):.0f} m on", tip,
              (-beside_pt if right else beside_pt, -10 if up else 10), **alignment)
    if not inside:
        return []
    axes.scatter(*np.array(inside).T, s=260, marker="*", color="#F0E442", edgecolors="black", zorder=8)
    return [Line2D([], [], linestyle="", marker="*", markersize=13, color="#F0E442", markeredgecolor="black",
                   label="goal")]


def _tell(axes: plt.Axes, text: str, place, offset_pt: tuple[float, float], **alignment) -> None:
    axes.annotate(text, place, xytext=offset_pt, textcoords="offset points", fontweight="bold", zorder=8,
                  path_effects=[patheffects.withStroke(linewidth=3, foreground="white")], **alignment)

