"""Small logs of known content."""

from pathlib import Path

import blosc
import lcm
import nanomap
import numpy as np

START_US = 999_900_000  # the log crosses a second boundary
FRAME_US = 33_000
WIDTH, HEIGHT = 32, 24


def camera() -> nanomap.camera_model_t:
    message = nanomap.camera_model_t()
    message.name = "depth"
    message.width, message.height = WIDTH, HEIGHT
    message.fx = message.fy = 16.0
    message.cx, message.cy = (WIDTH - 1) / 2, (HEIGHT - 1) / 2
    message.body_from_camera.rotation = [0.5, -0.5, 0.5, -0.5]
    message.depth_unit, message.min_range, message.max_range = 0.001, 0.3, 10.0
    message.num_no_return_values, message.no_return_values = 1, [0]
    return message


def pose(utime: int, x_m: float, epoch: int = 0) -> nanomap.body_pose_t:
    message = nanomap.body_pose_t()
    message.utime, message.epoch = utime, epoch
    message.world_from_body.translation = [x_m, 0.0, 1.0]
    message.world_from_body.rotation = [1.0, 0.0, 0.0, 0.0]
    return message


def depth(utime: int, counts: np.ndarray, compression: int) -> nanomap.depth_image_t:
    message = nanomap.depth_image_t()
    message.utime, message.camera, message.depth_unit = utime, "depth", 0.001
    message.height, message.width = counts.shape
    message.compression = compression
    raw = counts.astype("<u2").tobytes()
    message.data = raw if compression == nanomap.depth_image_t.RAW else blosc.compress(raw, typesize=2)
    message.size = len(message.data)
    return message


def answer(status: int, view: int, view_utime: int) -> nanomap.answer_t:
    message = nanomap.answer_t()
    message.status, message.has_view = status, True
    message.view_index, message.view_utime = view, view_utime
    message.mean_camera = [0.0, 0.0, 2.0]
    message.covariance_camera = [0.01, 0, 0, 0, 0.01, 0, 0, 0, 0.01]
    message.num_neighbours, message.neighbours, message.distances = 1, [[0.0, 0.0, 3.0]], [1.0]
    return message


def answers(utime: int, x_m: float, replies: list[nanomap.answer_t], views: int, fan: int) -> nanomap.answers_t:
    message = nanomap.answers_t()
    message.utime, message.num_views, message.num_fan = utime, views, fan
    message.world_from_body = pose(utime, x_m).world_from_body
    message.num_answers, message.answers = len(replies), replies
    return message


def trajectory(utime: int, x_m: float, speed_m_s: float, pieces: list[tuple[float, float]]) -> nanomap.trajectory_t:
    """Along x from (x_m, 0, 1); pieces of a duration [s] and a jerk along y [m/s^3]."""
    message = nanomap.trajectory_t()
    message.utime, message.position, message.velocity = utime, [x_m, 0.0, 1.0], [speed_m_s, 0.0, 0.0]
    message.num_pieces = len(pieces)
    message.piece_duration = [duration for duration, _ in pieces]
    message.piece_jerk = [[0.0, jerk, 0.0] for _, jerk in pieces]
    return message


def decision(utime: int, x_m: float, reason: str = "flying", risk: float = 1e-5, epoch: int = 0) -> nanomap.decision_t:
    """A metre or two ahead, with a verified brake, if it flies; else nothing to be flown. Of 10 candidates 3 are left
    out and 1 is feasible."""
    message = nanomap.decision_t()
    message.utime, message.epoch, message.reason = utime, epoch, reason
    message.has_goal, message.goal_sequence = True, 0
    message.has_motion = message.has_brake = reason == "flying"
    if message.has_motion:
        message.trajectory = trajectory(utime, x_m, 2.0, [(0.2, 1.0), (0.8, 0.0)])
        message.brake = trajectory(utime, x_m, 1.0, [(0.5, 1.0)])
    message.risk, message.brake_risk = risk, risk / 10
    message.num_candidates, message.num_evaluated, message.num_feasible = 10, 7, 1
    message.num_statuses, message.vetoes = 9, [0, 0, 0, 2, 0, 0, 1, 0, 0]
    message.vetoes_neighbours, message.vetoes_of_brakes = 3, 1
    return message


def goal(utime: int, x_m: float, sequence: int = 0) -> nanomap.goal_t:
    message = nanomap.goal_t()
    message.utime, message.sequence = utime, sequence
    message.position, message.top_speed = [x_m, 1.0, 1.0], 4.0
    return message


def health(utime: int, latencies: dict[str, tuple[float, float, float]]) -> nanomap.health_t:
    """`latencies`: median, 99 % and longest in s, by name; of a hundred each."""
    message = nanomap.health_t()
    message.utime = utime
    message.num_latencies = len(latencies)
    for name, (p50, p99, longest) in latencies.items():
        latency = nanomap.latency_t()
        latency.name, latency.count, latency.p50, latency.p99, latency.max = name, 100, p50, p99, longest
        message.latencies.append(latency)
    return message


def write(path: Path, messages: list[tuple[str, int, object]]) -> Path:
    """Each message with its channel and log time."""
    log = lcm.EventLog(str(path), "w", overwrite=True)
    for channel, log_utime, message in messages:
        log.write_event(log_utime, channel, message if isinstance(message, bytes) else message.encode())
    log.close()
    return path


def write_flight(folder: Path, frames: int = 5) -> tuple[Path, Path]:
    """A log and its answers: the third frame's come from deepest in the history."""
    inputs = [("CAMERA", START_US, camera())]
    replies = []
    for i in range(frames):
        utime = START_US + i * FRAME_US
        inputs.append(("POSE_BODY", utime, pose(utime, 0.1 * i)))
        inputs.append(("TRUTH_POSE_BODY", utime, pose(utime, 50.0)))
        inputs.append(("DEPTH", utime + 1000, depth(utime, np.full((HEIGHT, WIDTH), 3000 + i), i % 2)))
        deep = [answer(0, min(i, 1), utime - min(i, 1) * FRAME_US)] * (3 if i == 2 else 0)
        shallow = [answer(4, 0, utime)] * (4 - len(deep))
        replies.append(("NANOMAP_ANSWERS", utime + 1000, answers(utime, 0.1 * i, deep + shallow, i + 1, fan=3)))
    return write(folder / "in.log", inputs), write(folder / "answers.log", replies)
