"""How likely an error is longer than a radius: the tail of a weighted sum of squares, by quadrature."""

from math import erfc

import numpy as np

# Far more nodes than 1e-9 of precision needs, for standard deviations that differ up to tenfold.
NODES, WEIGHTS = np.polynomial.legendre.leggauss(96)
NEGLIGIBLE_SIGMAS = 8.0  # the tail there is below 1e-13


def tail(covariance: np.ndarray, radius: float) -> float:
    """P(|e| > radius) for e ~ N(0, covariance) in three dimensions.

    Split by the coordinate z of the smallest variance: outside the ball for certain beyond the radius; within it, the
    tail of the other two beyond sqrt(radius^2 - z^2), which is an integral over the direction in their plane.
    """
    if radius <= 0:
        return 1.0
    third, second, first = np.linalg.eigvalsh(covariance)
    if radius > NEGLIGIBLE_SIGMAS * np.sqrt(first):
        return 0.0
    # All of what z's density holds, so that the nodes lie where it is.
    reach = min(radius, NEGLIGIBLE_SIGMAS * np.sqrt(third * first / max(first - third, third * 1e-3)))
    z, z_weights = (NODES + 1) / 2 * reach, WEIGHTS / 2 * reach
    angle, angle_weights = (NODES + 1) / 2 * np.pi / 2, WEIGHTS / 2  # mean over a quadrant
    steepness = np.cos(angle)**2 / first + np.sin(angle)**2 / second
    planar = np.exp(-(radius**2 - z**2)[:, None] * steepness / 2) / (steepness * np.sqrt(first * second))
    density = 2 * np.exp(-z**2 / (2 * third)) / np.sqrt(2 * np.pi * third)  # both signs of z
    inside = z_weights * density @ (planar @ angle_weights)
    return float(min(erfc(radius / np.sqrt(2 * third)) + inside, 1.0))
