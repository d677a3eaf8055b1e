"""Motions with constant jerk in each piece, from their messages."""

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class States:
    """One row a moment, in W [m, m/s, m/s^2]."""

    position: np.ndarray
    velocity: np.ndarray
    acceleration: np.ndarray


class Motion:
    def __init__(self, message):
        self.utime = message.utime
        self.durations = np.array(message.piece_duration, dtype=float)
        self.jerks = np.array(message.piece_jerk, dtype=float).reshape(-1, 3)
        self.starts = np.concatenate([[0.0], np.cumsum(self.durations)])  # s, of each piece, and the end
        states = [np.array([message.position, message.velocity, message.acceleration], dtype=float)]
        for duration, jerk in zip(self.durations, self.jerks):
            states.append(_integrate(states[-1], jerk, duration))
        self._at_starts = np.array(states)

    @property
    def duration(self) -> float:
        return float(self.starts[-1])

    def boundaries(self) -> States:
        """Where the pieces meet, start and end included: accelerations are largest there."""
        return States(*np.moveaxis(self._at_starts, 1, 0))

    def at(self, elapsed: np.ndarray) -> States:
        """After the end it is the end's state."""
        elapsed = np.minimum(np.asarray(elapsed, dtype=float), self.duration)
        piece = np.clip(np.searchsorted(self.starts, elapsed, side="right") - 1, 0, len(self.durations))
        jerks = np.vstack([self.jerks, np.zeros(3)])
        rows = [_integrate(self._at_starts[i], jerks[i], t - self.starts[i]) for i, t in zip(piece, elapsed)]
        return States(*np.moveaxis(np.array(rows), 1, 0))

    def dense_times(self, spacing_m: float) -> np.ndarray:
        """Moments between which the motion covers no more than about `spacing_m`, start and end included."""
        grid = np.linspace(0, self.duration, 65)
        fastest = np.linalg.norm(self.at(grid).velocity, axis=1).max()
        return np.linspace(0, self.duration, int(np.ceil(self.duration * fastest / spacing_m)) + 2)


def _integrate(state: np.ndarray, jerk: np.ndarray, t: float) -> np.ndarray:
    """Taylor's series, which ends with the jerk."""
    position, velocity, acceleration = state
    return np.array([position + t * (velocity + t * (acceleration / 2 + t * jerk / 6)),
                     velocity + t * (acceleration + t * jerk / 2), acceleration + t * jerk])
