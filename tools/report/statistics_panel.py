"""Shares of the statuses and how far back answers came from, over the whole log."""

import matplotlib.pyplot as plt
import numpy as np
from moment import Statistics
from nanomap_log import Status
from style import LOOKS

DEPTH_BINS = (0, 1, 2, 5, 10, 20, 40, 80, 160)


def draw_statuses(axes: plt.Axes, statistics: Statistics) -> None:
    """One stacked bar for the fan of motions, one for the path that was flown."""
    rows = (("fan of\nmotions", statistics.fan), ("path flown\nnext", statistics.flown))
    for row, (_, counts) in enumerate(rows):
        left = 0.0
        for status in Status:
            share = 100 * counts[status] / max(counts.sum(), 1)
            axes.barh(row, share, left=left, color=LOOKS[status].colour, edgecolor="white", linewidth=0.5)
            if share >= 6:
                axes.text(left + share / 2, row, f"{share:.0f} %", ha="center", va="center", fontsize=8, color="white")
            left += share
    axes.set_yticks(range(len(rows)), [name for name, _ in rows])
    axes.invert_yaxis()
    axes.set_xlim(0, 100)
    axes.set_xlabel("share of answers [%]")
    axes.set_title(f"Whole log: {statistics.answers:,} answers by status")


def draw_depths(axes: plt.Axes, statistics: Statistics) -> None:
    """Of the answers that a view contained: how many views back that was."""
    deepest = statistics.depths.max(initial=0)
    # Each bin twice as deep as the one before: most answers come from the newest views.
    edges = [start for start in DEPTH_BINS if start <= deepest] + [deepest + 1]
    counts, _ = np.histogram(statistics.depths, bins=edges)
    shares = 100 * counts / max(counts.sum(), 1)
    labels = [f"{a}" if b - a == 1 else f"{a}..{b - 1}" for a, b in zip(edges, edges[1:])]
    bars = axes.bar(range(len(shares)), shares, color="#3b6ea5")
    axes.bar_label(bars, [f"{share:.1f}" for share in shares], fontsize=8)
    axes.set_xticks(range(len(shares)), labels, fontsize=8)
    axes.set_ylim(0, max(1.15 * shares.max(), 1))
    axes.set_xlabel("views back from the newest (0)")
    axes.set_ylabel("answers inside a view [%]")
    axes.set_title("Whole log: how far back the answering view was")
