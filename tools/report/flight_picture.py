"""The picture of a whole flight: what was seen, flown and decided, from above and over time."""

from pathlib import Path

import candidates_panel
import flight_map_panel
import latency_panel
import matplotlib.pyplot as plt
import timeline_panels
from flight import Flight
from flight_summary import summarise

DPI = 140
FONT_PT = 11  # still legible at half the size
WIDTH_IN, PANELS_HEIGHT_IN = 13, 6.2
MAP_WIDTH_IN, MAP_HEAD_IN = 11.3, 1.5  # without and with what stands around it
LAYOUT = [["map", "map"], ["outcomes", "risks"], ["speeds", "candidates"], ["clearance", "candidates"]]
LIVE_LAYOUT = [*LAYOUT[:2], ["speeds", "latencies"], ["clearance", "candidates"]]


def draw(flight: Flight, out: Path) -> None:
    with plt.rc_context({"font.size": FONT_PT, "axes.titlesize": FONT_PT + 1, "axes.titleweight": "bold",
                         "axes.titlelocation": "left", "legend.fontsize": FONT_PT - 1.5, "legend.frameon": False}):
        summary = summarise(flight)
        shown = flight_map_panel.frame(flight)
        map_height_in = MAP_WIDTH_IN * shown.height_to_width + MAP_HEAD_IN
        figure, axes = plt.subplot_mosaic(LIVE_LAYOUT if flight.healths else LAYOUT, layout="constrained",
                                          figsize=(WIDTH_IN, map_height_in + PANELS_HEIGHT_IN),
                                          height_ratios=(3 * map_height_in / PANELS_HEIGHT_IN, 1, 1, 1))
        flight_map_panel.draw(axes["map"], flight, shown)
        timeline_panels.draw_outcomes(axes["outcomes"], flight, summary)
        timeline_panels.draw_speeds(axes["speeds"], flight)
        timeline_panels.draw_clearance(axes["clearance"], flight)
        timeline_panels.draw_risks(axes["risks"], flight)
        candidates_panel.draw(axes["candidates"], flight)
        if flight.healths:
            latency_panel.draw(axes["latencies"], flight)
        _share_time([panel for name, panel in axes.items() if name != "map"], flight)
        what = "flown by these decisions" if flight.own else "what a replay decided along this flight"
        figure.suptitle(f"{flight.log.name}: {what}\n{summary.words()}", fontsize=FONT_PT + 2)
        figure.savefig(out, dpi=DPI)
        plt.close(figure)


def _share_time(panels: list[plt.Axes], flight: Flight) -> None:
    """The same time everywhere, told below the lowest panel of each column."""
    for panel in panels:
        panel.set_xlim(flight.seconds(flight.utime_range()))
        if panel.get_subplotspec().is_last_row():
            panel.set_xlabel("time in the log [s]")
        else:
            panel.tick_params(labelbottom=False)
