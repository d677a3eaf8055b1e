"""The picture of one moment of a replay, with statistics of all of it."""

from pathlib import Path

import depth_panel
import map_panel
import matplotlib.pyplot as plt
import statistics_panel
from matplotlib.lines import Line2D
from moment import Moment
from style import LOOKS

WIDTH_IN, HEIGHT_IN, DPI = 18, 10.5, 100


def draw(moment: Moment, out: Path) -> None:
    figure = plt.figure(figsize=(WIDTH_IN, HEIGHT_IN), layout="constrained")
    grid = figure.add_gridspec(3, 2, width_ratios=(1, 1.15), height_ratios=(2.6, 0.8, 1.2))
    depth_panel.draw(figure.add_subplot(grid[0, 0]), moment)
    statistics_panel.draw_statuses(figure.add_subplot(grid[1, 0]), moment.statistics)
    statistics_panel.draw_depths(figure.add_subplot(grid[2, 0]), moment.statistics)
    map_panel.draw(figure.add_subplot(grid[:, 1]), moment)
    marks = [Line2D([], [], linestyle="", marker=look.marker, color=look.colour, label=look.label, markersize=8)
             for look in LOOKS.values()]
    figure.legend(handles=marks, loc="outside lower center", ncols=len(marks), fontsize=9, frameon=False,
                  title="Status of an answered point (with its 1-sigma ellipse in the answering view)")
    figure.suptitle(f"NanoMap: {moment.log.name} at {moment.seconds:.2f} s, {len(moment.answers.answers)} points "
                    f"answered from {moment.answers.num_views} views", fontsize=15)
    figure.savefig(out, dpi=DPI)
