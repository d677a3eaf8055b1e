"""How long the flight process took, second by second, as its health reports say."""

import matplotlib.pyplot as plt
import numpy as np
from flight import Flight
from style import legend_on_title_line

MS_PER_S = 1000
COLOURS = ("#0072B2", "#E69F00", "#009E73", "#CC79A7", "#D55E00", "#56B4E9")
LEAST_MS = 1e-3  # as good as no time; a logarithmic axis has no zero


def draw(axes: plt.Axes, flight: Flight) -> None:
    """Of each time the median as a line, and a band up to what 99 of 100 did not exceed; the longest as a dot."""
    seconds = flight.seconds([health.utime for health in flight.healths])
    names = list(dict.fromkeys(latency.name for health in flight.healths for latency in health.latencies))
    for name, colour in zip(names, COLOURS):
        p50, p99, longest = _times_ms(flight.healths, name).T
        axes.fill_between(seconds, p50, p99, color=colour, alpha=0.3, linewidth=0)
        axes.plot(seconds, p50, color=colour, linewidth=1.6, label=name)
        axes.plot(seconds, longest, color=colour, linestyle="", marker=".", markersize=4)
    axes.set_yscale("log")
    axes.set_ylabel("time [ms]")
    axes.set_title("Latencies")
    legend_on_title_line(axes, handle_length=0.8)


def _times_ms(healths: list, name: str) -> np.ndarray:
    """One row a report; NaN where nothing was measured."""
    rows = np.full((len(healths), 3), np.nan)
    for row, health in zip(rows, healths):
        for latency in health.latencies:
            if latency.name == name and latency.count:
                row[:] = np.maximum(MS_PER_S * np.array([latency.p50, latency.p99, latency.max]), LEAST_MS)
    return rows
