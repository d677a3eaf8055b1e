"""What looks the same in every panel. Colours of Okabe and Ito, told apart by colour-blind readers too."""

from dataclasses import dataclass

import matplotlib.pyplot as plt
from nanomap_log import Status

# Ground and crowns would cover everything: a view from above shows what is this near to the vehicle's height.
HEIGHT_BAND_M = 1.0


@dataclass(frozen=True)
class Look:
    label: str
    colour: str
    marker: str


LOOKS = {
    Status.FREE: Look("free", "#009E73", "o"),
    Status.PARTIAL: Look("partial: box not inside the view", "#E69F00", "^"),
    Status.OPEN: Look("open: sky", "#56B4E9", "s"),
    Status.HOLE: Look("hole: no depth", "#CC79A7", "P"),
    Status.OCCLUDED: Look("occluded", "#D55E00", "X"),
    Status.BEYOND_RANGE: Look("beyond range", "#0072B2", "D"),
    Status.OUTSIDE_FOV: Look("outside the field of view", "#9A9A9A", "v"),
    Status.BEHIND: Look("behind the camera", "#4D4D4D", "<"),
    Status.EMPTY: Look("no view yet", "#000000", "*"),
}

MOTION_COLOUR = "#000000"
BRAKE_COLOUR = "#D55E00"


def legend_on_title_line(axes: plt.Axes, handle_length: float = 1.4) -> None:
    """Where it covers nothing."""
    axes.legend(loc="lower right", bbox_to_anchor=(1.01, 0.98), ncols=4, columnspacing=1.0, handlelength=handle_length,
                handletextpad=0.5, borderaxespad=0)
