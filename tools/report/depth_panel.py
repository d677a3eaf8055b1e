"""The newest depth image with the points that its view answers."""

import matplotlib.pyplot as plt
import numpy as np
from moment import Moment
from nanomap_log import Status, depth_counts
from style import LOOKS


def draw(axes: plt.Axes, moment: Moment) -> None:
    camera, view = moment.camera, moment.views[0]
    counts = depth_counts(view.image)
    depth_m = np.ma.masked_where(np.isin(counts, camera.no_return_values), counts * camera.depth_unit)
    colours = plt.get_cmap("cividis_r").with_extremes(bad="#e4e4e4")
    picture = axes.imshow(depth_m, cmap=colours, vmin=camera.min_range, vmax=camera.max_range, interpolation="nearest")
    bar = axes.figure.colorbar(picture, ax=axes, fraction=0.035, pad=0.02, extend="both")
    bar.set_label("depth along the optical axis [m]; grey: none")

    for status, look in LOOKS.items():
        pixels = _pixels(moment, status)
        if len(pixels):
            axes.scatter(*pixels.T, s=34, marker=look.marker, color=look.colour, edgecolors="black", linewidths=0.6)
    axes.set_xlim(-0.5, camera.width - 0.5)
    axes.set_ylim(camera.height - 0.5, -0.5)
    axes.set_xlabel("column [px]")
    axes.set_ylabel("row [px]")
    axes.set_title(f"Newest view ({view.age_s * 1000:.0f} ms old) and the points that it answers")


def _pixels(moment: Moment, status: Status) -> np.ndarray:
    """Means in the newest view's image, n x 2 [px]."""
    camera = moment.camera
    means = np.array([a.mean_camera for a in moment.answers.answers
                      if a.status == status and a.has_view and a.view_index == 0]).reshape(-1, 3)
    x, y, z = means[means[:, 2] > camera.min_range].T
    pixels = np.column_stack([camera.fx * x / z + camera.cx, camera.fy * y / z + camera.cy])
    inside = np.all((pixels >= -0.5) & (pixels <= [camera.width - 0.5, camera.height - 0.5]), axis=1)
    return pixels[inside]
