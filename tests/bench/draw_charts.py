"""Draws the charts of the README from what `nanomap-bench --ratios --json FILE` wrote."""

import argparse
import json
import pathlib

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import matplotlib.ticker

REACHED = "#2a7f62"
SHORT = "#c4622d"
REFERENCE = "#9aa4ad"


def draw_ratios(results, file):
    """How many times faster than its reference, row by row, with the bar that it has to reach."""
    rows = [row for row in results["rows"] if "value" in row and not row["at_most"]]
    figure, axes = plt.subplots(figsize=(8, 0.3 * len(rows) + 1.2), layout="constrained")
    places = range(len(rows), 0, -1)
    colors = [REACHED if row["reached"] else SHORT for row in rows]
    axes.barh(places, [row["value"] for row in rows], color=colors, height=0.7)
    for place, row in zip(places, rows):
        axes.plot([row["bar"], row["bar"]], [place - 0.4, place + 0.4], color="black", linewidth=1.5)
        axes.annotate(f"{row['value']:.3g}x", (max(row["value"], row["bar"]), place), xytext=(5, 0),
                      textcoords="offset points", va="center", fontsize=8)
    axes.set_yticks(list(places), [row["name"] for row in rows], fontsize=8)
    axes.set_xscale("log")
    axes.xaxis.set_major_formatter(matplotlib.ticker.FormatStrFormatter("%g"))
    axes.set_xlim(left=1.0)
    axes.set_xlabel("times faster than the reference, the worst of four scenes (line: the bar)")
    axes.set_title(f"{results['processor']}, {results['date']}", fontsize=9)
    axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(file, dpi=120)
    plt.close(figure)


def draw_times(results, scene, works, file):
    """Times of all contestants at the same work, each work in a panel."""
    figure, panels = plt.subplots(1, len(works), figsize=(3.1 * len(works), 2.8), layout="constrained")
    for axes, (work, title, unit, per_s) in zip(panels, works):
        times = [time for time in results["times"] if time["work"] == work and time["where"] == scene]
        if not times:
            raise SystemExit(f"no times of {work} in {scene}: was the file written with --ratios?")
        names = [time["contestant"] for time in times]
        values = [time["median_s"] * per_s for time in times]
        axes.bar(names, values, color=[REACHED if name == "nanomap" else REFERENCE for name in names])
        for i, value in enumerate(values):
            axes.annotate(f"{value:.3g}", (i, value), xytext=(0, 2), textcoords="offset points", ha="center",
                          fontsize=7)
        axes.set_yscale("log")
        axes.set_ylabel(unit)
        axes.set_title(title, fontsize=9)
        axes.tick_params(axis="x", rotation=60, labelsize=7)
        axes.spines[["top", "right"]].set_visible(False)
    figure.savefig(file, dpi=120)
    plt.close(figure)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("json", type=pathlib.Path, help="written by nanomap-bench --ratios --json")
    parser.add_argument("--out", type=pathlib.Path, default=pathlib.Path("."), help="folder for the pictures")
    parser.add_argument("--scene", default="forest_noisy", help="whose times are drawn")
    arguments = parser.parse_args()
    results = json.loads(arguments.json.read_text())
    arguments.out.mkdir(parents=True, exist_ok=True)
    draw_ratios(results, arguments.out / "ratios.png")
    draw_times(
        results, arguments.scene,
        [("build", "index of one 320x240 frame", "ms", 1e3),
         ("nearest_k1_uniform", "nearest point", "us a query", 1e6),
         ("cycle_75_percent_current", "frame inserted, 2,500 queries", "ms", 1e3)],
        arguments.out / "times.png")


if __name__ == "__main__":
    main()
