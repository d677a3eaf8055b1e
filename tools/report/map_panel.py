"""The scene from above, in the estimator's world W."""

import matplotlib.pyplot as plt
import numpy as np
from depth_points import measured_points, transformed
from inputs import US_PER_S
from matplotlib.collections import LineCollection
from matplotlib.patches import Ellipse, Polygon
from moment import Moment
from nanomap_log import Status
from style import HEIGHT_BAND_M, LOOKS

FRUSTUMS_SHOWN = 12
POINT_VIEWS_SHOWN = 6
POINTS_A_VIEW = 4000
OBSTACLE_LINES = 24
PATH_S = 4.0
MARGIN_M = 1.5


def draw(axes: plt.Axes, moment: Moment) -> None:
    body_W = np.array(moment.answers.world_from_body.translation)
    _draw_frustums(axes, moment)
    seen = _draw_depth_points(axes, moment, body_W[2])
    asked = _draw_answers(axes, moment, body_W[2])
    _draw_path(axes, moment, body_W)
    _frame(axes, np.vstack([seen, asked, body_W[None, :2]]), moment)
    axes.set_aspect("equal")
    axes.set_xlabel("x of W [m]")
    axes.set_ylabel("y of W [m]")
    axes.grid(color="#eeeeee", zorder=0)
    axes.set_title(f"From above: what is within {HEIGHT_BAND_M:g} m of the vehicle's height")
    legend = axes.legend(loc="upper left", fontsize=8, framealpha=0.9)
    for handle in legend.legend_handles:
        handle.set_alpha(1)


def _draw_frustums(axes: plt.Axes, moment: Moment) -> None:
    camera = moment.camera
    z = camera.max_range
    sides = [(-0.5 - camera.cx) / camera.fx * z, (camera.width - 0.5 - camera.cx) / camera.fx * z]
    corners_C = np.array([[0, 0, 0, 1], [sides[0], 0, z, 1], [sides[1], 0, z, 1]])
    shown = moment.views[::max(1, len(moment.views) // FRUSTUMS_SHOWN)]
    for i, view in reversed(list(enumerate(shown))):
        corners_W = (view.T_W_C @ corners_C.T).T
        strength = 1 - i / len(shown)
        axes.add_patch(Polygon(corners_W[:, :2], closed=True, fill=i == 0, facecolor="#dbe9f6",
                               edgecolor="#3b6ea5", linewidth=1.6 if i == 0 else 0.7, alpha=0.15 + 0.6 * strength,
                               zorder=1, label="newest view's frustum" if i == 0 else
                               f"{len(moment.views)} views back to {moment.views[-1].age_s:.1f} s (some)"
                               if i == 1 else None))


def _draw_depth_points(axes: plt.Axes, moment: Moment, height_m: float) -> np.ndarray:
    camera = moment.camera
    shown = moment.views[::max(1, len(moment.views) // POINT_VIEWS_SHOWN)]
    drawn = []
    for i, view in reversed(list(enumerate(shown))):
        points_W = transformed(view.T_W_C, measured_points(view.image, camera))
        points_W = points_W[np.abs(points_W[:, 2] - height_m) < HEIGHT_BAND_M]
        points_W = points_W[::max(1, len(points_W) // POINTS_A_VIEW)]
        axes.scatter(points_W[:, 0], points_W[:, 1], s=1.5, color="#222222", alpha=0.7 if i == 0 else 0.15,
                     linewidths=0, zorder=2, label="depth points" if i == 0 else None)
        drawn.append(points_W[:, :2])
    return np.vstack(drawn)


def _draw_answers(axes: plt.Axes, moment: Moment, height_m: float) -> np.ndarray:
    drawn, lines = [], []
    for answer in moment.answers.answers:
        T_W_C = moment.T_W_C(answer)
        if T_W_C is None:
            continue
        mean_W = T_W_C @ [*answer.mean_camera, 1]
        if abs(mean_W[2] - height_m) > HEIGHT_BAND_M:
            continue
        status = Status(answer.status)
        look = LOOKS[status]
        R = T_W_C[:3, :3]
        covariance_W = R @ np.reshape(answer.covariance_camera, (3, 3)) @ R.T
        _draw_ellipse(axes, mean_W[:2], covariance_W[:2, :2], look.colour)
        axes.scatter(*mean_W[:2], s=22, marker=look.marker, color=look.colour, edgecolors="white", linewidths=0.4,
                     zorder=5)
        drawn.append(mean_W[:2])
        if status == Status.FREE and answer.num_neighbours:
            lines.append((mean_W[:2], (T_W_C @ [*answer.neighbours[0], 1])[:2]))
    lines = lines[::max(1, len(lines) // OBSTACLE_LINES)]
    axes.add_collection(LineCollection(lines, colors="#b03060", linewidths=0.9, zorder=4,
                                       label="to the nearest obstacle (some)"))
    return np.array(drawn).reshape(-1, 2)


def _draw_ellipse(axes: plt.Axes, centre: np.ndarray, covariance: np.ndarray, colour: str) -> None:
    """The 1-sigma ellipse."""
    variances, directions = np.linalg.eigh(covariance)
    width, height = 2 * np.sqrt(np.maximum(variances, 0))
    angle_deg = np.degrees(np.arctan2(directions[1, 0], directions[0, 0]))
    axes.add_patch(Ellipse(centre, width, height, angle=angle_deg, fill=False, edgecolor=colour, linewidth=0.7,
                           alpha=0.8, zorder=3))


def _draw_path(axes: plt.Axes, moment: Moment, body_W: np.ndarray) -> None:
    track, now = moment.track, moment.answers.utime
    past = track.positions[(track.utimes <= now)]
    future = track.positions[(track.utimes >= now) & (track.utimes <= now + PATH_S * US_PER_S)]
    axes.plot(past[:, 0], past[:, 1], color="#000000", linewidth=1.6, zorder=6, label="flown path")
    axes.plot(future[:, 0], future[:, 1], color="#000000", linewidth=1.2, linestyle="--", zorder=6,
              label=f"flown in the next {PATH_S:g} s")
    axes.scatter(*body_W[:2], s=90, marker="o", facecolors="#ffd400", edgecolors="black", zorder=7, label="vehicle")


def _frame(axes: plt.Axes, points: np.ndarray, moment: Moment) -> None:
    """What matters now, not the whole flight: the points asked about and seen, within the camera's reach."""
    body = np.array(moment.answers.world_from_body.translation)[:2]
    reach = 1.2 * moment.camera.max_range
    near = points[np.all(np.abs(points - body) < reach, axis=1)]
    low, high = near.min(axis=0) - MARGIN_M, near.max(axis=0) + MARGIN_M
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
