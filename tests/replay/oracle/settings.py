"""What the oracle needs of the module's configuration file, read on its own."""

import tomllib
from dataclasses import dataclass
from pathlib import Path

US_PER_S = 1_000_000


@dataclass(frozen=True)
class Settings:
    history_views: int
    waiting_views: int
    pose_capacity: int
    max_pose_gap_us: int
    max_lead_us: int
    horizontal_std_m: float
    vertical_std_m: float
    after_s: float
    linear_growth: bool
    use_increments: bool
    neighbours: int
    open_window_px: int
    open_range_fraction: float
    open_frame_m: float


def read_document(path: Path, overrides: list[str]) -> dict:
    """The file's sections, with `overrides` "section.key=value", as nanomap-replay's --set takes them."""
    document = tomllib.loads(path.read_text())
    for override in overrides:
        name, value = override.split("=", 1)
        section, key = name.split(".")
        document[section][key] = tomllib.loads(f"value = {value}")["value"]
    return document


def read_settings(path: Path, overrides: list[str]) -> Settings:
    """Every key must be in the file: the oracle has no defaults that could agree with the module's by chance."""
    document = read_document(path, overrides)
    history, drift, query = document["history"], document["drift"], document["query"]
    if query["occlusion"] != "mean" or "camera" in document:
        raise ValueError(f"{path}: the oracle knows occlusion of the mean and cameras from the log only")
    return Settings(
        history_views=history["views"],
        waiting_views=history["waiting_views"],
        pose_capacity=history["pose_capacity"],
        max_pose_gap_us=round(history["max_pose_gap_s"] * US_PER_S),
        max_lead_us=round(history["max_lead_s"] * US_PER_S),
        horizontal_std_m=drift["horizontal_std_m"],
        vertical_std_m=drift["vertical_std_m"],
        after_s=drift["after_s"],
        linear_growth={"linear": True, "square_root": False}[drift["law"]],
        use_increments=drift["use_increments"],
        neighbours=query["k"],
        open_window_px=query["open_window_px"],
        open_range_fraction=query["open_range_fraction"],
        open_frame_m=query["open_frame_m"],
    )
