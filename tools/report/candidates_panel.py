"""What became of the planner's candidates, over time."""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import nanomap
import numpy as np
from flight import Flight
from matplotlib.transforms import ScaledTranslation
from style import LOOKS

FEASIBLE_COLOUR = "#009E73"
NEIGHBOURS_COLOUR = "#E8D8A8"
NOT_EVALUATED_COLOUR = "#EDEDED"
BELOW_IN = 0.45  # the time axis has its numbers and its name there


@dataclass(frozen=True)
class Layer:
    label: str
    colour: str
    counts: np.ndarray  # by decision


def layers(decisions: list[nanomap.decision_t]) -> list[Layer]:
    """All candidates of each decision, every one in one layer. Statuses that vetoed nothing are left out."""
    vetoes = np.array([d.vetoes for d in decisions])
    return [
        Layer("feasible", FEASIBLE_COLOUR, np.array([d.num_feasible for d in decisions])),
        Layer("obstacle too near", NEIGHBOURS_COLOUR, np.array([d.vetoes_neighbours for d in decisions])),
        *(Layer(look.label.partition(":")[0], look.colour, vetoes[:, status])
          for status, look in LOOKS.items() if vetoes[:, status].any()),
        Layer("not evaluated", NOT_EVALUATED_COLOUR, np.array([d.num_candidates - d.num_evaluated for d in decisions])),
    ]


def draw(axes: plt.Axes, flight: Flight) -> None:
    decisions, seconds = flight.decisions, flight.decision_seconds
    stacked = layers(decisions)
    axes.stackplot(seconds, [layer.counts for layer in stacked], colors=[layer.colour for layer in stacked],
                   labels=[layer.label for layer in stacked], step="post", linewidth=0)
    of_brakes = [d.vetoes_of_brakes for d in decisions]
    if any(of_brakes):
        axes.plot(seconds, of_brakes, color="#000000", linewidth=1.4, drawstyle="steps-post",
                  label="vetoed for the brake")
    axes.set_ylim(0, max(1, *(d.num_candidates for d in decisions)))
    axes.set_ylabel("candidates")
    axes.set_title("Candidates: feasible, or what vetoed them")
    below = ScaledTranslation(0, -BELOW_IN, axes.figure.dpi_scale_trans)
    axes.legend(loc="upper center", bbox_to_anchor=(0.47, 0), bbox_transform=axes.transAxes + below, ncols=3,
                columnspacing=1.0, handlelength=1.0)
