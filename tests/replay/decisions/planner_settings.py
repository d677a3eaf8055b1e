"""What the check needs of the planner's configuration, read on its own: every key must be in the file."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
from nanomap_log import Status
from settings import read_document


@dataclass(frozen=True)
class Deviation:
    """How a standard deviation of the vehicle's place grows on a motion."""

    base_m: float
    per_speed_s: float
    per_time_m_s: float

    def at(self, speed: np.ndarray, elapsed: np.ndarray) -> np.ndarray:
        return self.base_m + self.per_speed_s * speed + self.per_time_m_s * elapsed


@dataclass(frozen=True)
class PlannerSettings:
    radius_m: float
    bubble_m: float  # from the body's origin
    brake_after_s: float
    samples: int
    brake_samples: int
    horizontal_at_rest_m_s2: float
    horizontal_at_full_m_s2: float
    full_speed_m_s: float
    vertical_m_s2: float
    jerk_m_s3: float
    min_horizon_s: float
    max_horizon_s: float
    horizon_m: float
    max_risk: float
    look_beside: bool
    beside_beyond_m: float
    horizontal: Deviation
    vertical: Deviation
    prior: np.ndarray  # by Status
    max_position_error_m: float
    recovery_s: float
    max_velocity_error_m_s: float

    def horizontal_limit_m_s2(self, speed_m_s: float) -> float:
        return float(np.interp(speed_m_s, [0, self.full_speed_m_s],
                               [self.horizontal_at_rest_m_s2, self.horizontal_at_full_m_s2]))

    def horizon_s(self, speed_m_s: float) -> float:
        wanted = self.horizon_m / speed_m_s if speed_m_s > 0 else np.inf
        return float(np.clip(wanted, self.min_horizon_s, self.max_horizon_s))


def read_planner_settings(path: Path, overrides: list[str]) -> PlannerSettings:
    document = read_document(path, overrides)
    vehicle, planner, limits, horizon, risk, tracking = (
        document[section] for section in ("vehicle", "planner", "limits", "horizon", "risk", "tracking"))
    if planner["stop_check"] != "verified" or risk["collision_model"] != "ball":
        raise ValueError(f"{path}: the check knows stop_check = verified and collision_model = ball only")
    return PlannerSettings(
        radius_m=vehicle["radius_m"],
        bubble_m=vehicle["radius_m"] + vehicle["bubble_margin_m"],
        brake_after_s=planner["brake_after_s"],
        samples=planner["samples"],
        brake_samples=planner["brake_samples"],
        horizontal_at_rest_m_s2=limits["horizontal_at_rest_m_s2"],
        horizontal_at_full_m_s2=limits["horizontal_at_full_m_s2"],
        full_speed_m_s=limits["full_speed_m_s"],
        vertical_m_s2=limits["vertical_m_s2"],
        jerk_m_s3=limits["jerk_m_s3"],
        min_horizon_s=horizon["min_s"],
        max_horizon_s=horizon["max_s"],
        horizon_m=horizon["distance_m"],
        max_risk=risk["max_risk"],
        look_beside=risk["look_beside"],
        beside_beyond_m=risk["beside_beyond_m"],
        horizontal=Deviation(*(risk[f"horizontal_{key}"] for key in ("base_m", "per_speed_s", "per_time_m_s"))),
        vertical=Deviation(*(risk[f"vertical_{key}"] for key in ("base_m", "per_speed_s", "per_time_m_s"))),
        prior=np.array([risk[f"prior_{status.name.lower()}"] for status in Status], dtype=float),
        max_position_error_m=tracking["max_position_error_m"],
        recovery_s=tracking["recovery_s"],
        max_velocity_error_m_s=tracking["max_velocity_error_m_s"],
    )
