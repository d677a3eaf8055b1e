"""Rigid motion on 4x4 matrices, by the exponential map: another road than the module's quaternions."""

import numpy as np


def inverse(T_A_B: np.ndarray) -> np.ndarray:
    R_B_A = T_A_B[:3, :3].T
    T_B_A = np.eye(4)
    T_B_A[:3, :3] = R_B_A
    T_B_A[:3, 3] = -R_B_A @ T_A_B[:3, 3]
    return T_B_A


def rotation_vector(R: np.ndarray) -> np.ndarray:
    """Axis times angle [rad] of a rotation by less than half a turn."""
    twice_sine_axis = np.array([R[2, 1] - R[1, 2], R[0, 2] - R[2, 0], R[1, 0] - R[0, 1]])
    sine = np.linalg.norm(twice_sine_axis) / 2
    angle = np.arctan2(sine, (np.trace(R) - 1) / 2)
    return twice_sine_axis / 2 * (angle / sine if sine > 0 else 1.0)


def rotation(vector: np.ndarray) -> np.ndarray:
    """The rotation about `vector` by its length [rad] (Rodrigues)."""
    angle = np.linalg.norm(vector)
    if angle == 0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


def interpolate(T_from: np.ndarray, T_to: np.ndarray, weight: float) -> np.ndarray:
    """Linear in translation, at constant angular rate in rotation."""
    T = np.eye(4)
    R_from = T_from[:3, :3]
    T[:3, :3] = R_from @ rotation(weight * rotation_vector(R_from.T @ T_to[:3, :3]))
    T[:3, 3] = T_from[:3, 3] + weight * (T_to[:3, 3] - T_from[:3, 3])
    return T
