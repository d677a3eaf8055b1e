"""What the planner was held to, from its configuration."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

DEFAULTS = Path(__file__).parents[2] / "firmware_app/config/default.toml"


@dataclass(frozen=True)
class Limits:
    max_risk: float  # the chance constraint
    vehicle_radius_m: float


def read_limits(config: Path | None) -> Limits:
    """Of a configuration file; what it leaves out, or None, is the module's default."""
    told = tomllib.loads(config.read_text()) if config else {}
    defaults = tomllib.loads(DEFAULTS.read_text())

    def value(section: str, key: str) -> float:
        return float(told.get(section, {}).get(key, defaults[section][key]))

    return Limits(max_risk=value("risk", "max_risk"), vehicle_radius_m=value("vehicle", "radius_m"))
