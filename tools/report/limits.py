"""What the planner was held to, from its configuration."""

import tomllib
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

DEFAULTS = Path(__file__).parents[2] / "firmware_app/config/default.toml"


@dataclass(frozen=True)
class Limits:
    max_risk: float  # the chance constraint
    vehicle_radius_m: float


@dataclass(frozen=True)
class DeviationGrowth:
    """planner/trajectory_risk.h"""

    base_m: float
    per_speed_s: float
    per_time_m_s: float

    def at(self, speed_m_s, elapsed_s):
        return self.base_m + self.per_speed_s * speed_m_s + self.per_time_m_s * elapsed_s


@dataclass(frozen=True)
class TrackingAllowance:
    """What plans take a vehicle to be off its motion by."""

    horizontal: DeviationGrowth
    vertical: DeviationGrowth
    recovery_s: float  # planner/aside.h


def read_limits(told: dict) -> Limits:
    """Of a configuration, section by section; what it leaves out is the module's default."""
    value = _values(told)
    return Limits(max_risk=value("risk", "max_risk"), vehicle_radius_m=value("vehicle", "radius_m"))


def read_tracking_allowance(told: dict) -> TrackingAllowance:
    """Likewise."""
    value = _values(told)

    def growth(direction: str) -> DeviationGrowth:
        return DeviationGrowth(*(value("risk", f"{direction}_{key}") for key in
                                 ("base_m", "per_speed_s", "per_time_m_s")))

    return TrackingAllowance(growth("horizontal"), growth("vertical"), value("tracking", "recovery_s"))


def _values(told: dict) -> Callable[[str, str], float]:
    defaults = tomllib.loads(DEFAULTS.read_text())
    return lambda section, key: float(told.get(section, {}).get(key, defaults[section][key]))
