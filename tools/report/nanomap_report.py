"""A picture of one moment of a replay, and statistics of all of it."""

import argparse
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")

import depth_panel
import map_panel
import matplotlib.pyplot as plt
import statistics_panel
from matplotlib.lines import Line2D
from moment import Moment, gather
from nanomap_log import read_channels
from style import LOOKS

WIDTH_IN, HEIGHT_IN, DPI = 18, 10.5, 100


def parse_arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="nanomap-report", description=__doc__)
    parser.add_argument("log", type=Path, help="LCM log that was replayed")
    parser.add_argument("answers", type=Path, help="answers: nanomap-replay LOG --out ANSWERS")
    parser.add_argument("--out", type=Path, required=True, help="PNG to write")
    parser.add_argument("--at", type=float, metavar="S", help="moment, in seconds after the log's first event; by "
                        "default one where many points are answered by views that are not the newest")
    parser.add_argument("--config", type=Path, help="configuration of the replay, for its channel names")
    return parser.parse_args()


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


def main() -> int:
    arguments = parse_arguments()
    try:
        channels = read_channels(arguments.config)
        draw(gather(arguments.log, arguments.answers, channels, arguments.at), arguments.out)
    except (ValueError, OSError) as error:
        print(f"nanomap-report: {error}", file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
