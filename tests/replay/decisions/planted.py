"""Faults planted into a right decision, to prove that the check sees each kind for what it is."""

import copy
from collections.abc import Iterator

import numpy as np
from evidence import Space
from in_force import Start
from motion import Motion
from nanomap_log import Status
from verify import IN_FORCE, STOPS, Fault, Verified, verify

DETOUR_S = 0.4
BEHIND_M = 0.5
PLACES = 100


def _with(decision, **changes):
    mutant = copy.deepcopy(decision)
    for path, value in changes.items():
        target, *rest = path.split("__")
        if rest:
            setattr(getattr(mutant, target), rest[0], value)
        else:
            setattr(mutant, target, value)
    return mutant


def _detour(message, displacement: np.ndarray):
    """The motion, then on for a while, `displacement` away from where it would have coasted to."""
    longer = copy.deepcopy(message)
    quarter_s = DETOUR_S / 4
    jerk = np.asarray(displacement) / (2 * quarter_s**3)
    longer.piece_duration = [*message.piece_duration, quarter_s, 2 * quarter_s, quarter_s]
    longer.piece_jerk = [*message.piece_jerk, list(jerk), list(-jerk), list(jerk)]
    longer.num_pieces += 3
    return longer


def _places(space: Space, behind_m: float, fallback_m: float | None = None) -> Iterator[np.ndarray]:
    """On the newest view's rays in W: so far behind what was measured, or at a distance where nothing was."""
    view = space.steps[0].view
    T_W_C = space.T_W_B @ np.linalg.inv(space.steps[0].T_C_newer)
    chosen = view.in_range if fallback_m is None else ~view.is_return
    pixels = np.argwhere(chosen)
    for row, column in pixels[::max(len(pixels) // PLACES, 1)]:
        z = view.depth_m[row, column] + behind_m if fallback_m is None else fallback_m
        ray = [(column - view.camera.cx) / view.camera.fx, (row - view.camera.cy) / view.camera.fy, 1.0]
        yield T_W_C[:3, :3] @ (z * np.array(ray)) + T_W_C[:3, 3]


def _led_to(decision, field: str, places: Iterator[np.ndarray], space: Space, status: Status | None):
    """The decision with one of its motions led to the first of the places that has the status; None without any."""
    message = getattr(decision, field)
    at_end = Motion(message).boundaries()
    coasted = (at_end.position + DETOUR_S * at_end.velocity + DETOUR_S**2 / 2 * at_end.acceleration)[-1]
    for place in places:
        if status is None or space.is_hidden(place, status):
            return _with(decision, **{field: _detour(message, place - coasted)})
    return None


def _jerk(decision, piece: int, factor: float):
    jerk = copy.deepcopy(decision.brake.piece_jerk)
    jerk[piece] = [factor * j for j in jerk[piece]]
    return _with(decision, brake__piece_jerk=jerk)


def _moving_brake(decision) -> bool:
    return decision.primitive not in STOPS and decision.brake.num_pieces > 2


# Name -> what the check must call it, and the change; None where the decision cannot carry it.
PLANTED = {
    "from another pose": (Fault.CONSUMED, lambda d, v, s: _with(d, pose_sequence=d.pose_sequence + 1)),
    "starts 1 mm away": (Fault.START, lambda d, v, s: _with(
        d, trajectory__position=[d.trajectory.position[0] + 1e-3, *d.trajectory.position[1:]])),
    "starts 1 mm/s faster": (Fault.START, lambda d, v, s: _with(
        d, brake__velocity=[d.brake.velocity[0] + 1e-3, *d.brake.velocity[1:]])),
    "brakes 1 % harder at first": (Fault.SHARED, lambda d, v, s: _jerk(d, 0, 1.01) if _moving_brake(d) else None),
    "speed left at the end": (Fault.REST, lambda d, v, s: _with(
        d, brake__piece_duration=[*d.brake.piece_duration[:-1], 0.9 * d.brake.piece_duration[-1]])
        if _moving_brake(d) else None),
    "acceleration above the limit": (Fault.LIMITS, lambda d, v, s: _with(d, trajectory__piece_jerk=[
        [0.0, 0.0, (1.1 * s.settings.vertical_m_s2 - d.trajectory.acceleration[2]) / d.trajectory.piece_duration[0]],
        *d.trajectory.piece_jerk[1:]]) if d.primitive not in STOPS else None),
    "keeps to the brake a little longer": (Fault.IN_FORCE, lambda d, v, s: _with(
        d, brake__piece_duration=[1.1 * d.brake.piece_duration[0], *d.brake.piece_duration[1:]])
        if d.primitive == IN_FORCE else None),
    "jerk above the limit": (Fault.LIMITS, lambda d, v, s: _with(
        d, brake=_detour(d.brake, [2.1 * s.settings.jerk_m_s3 * (DETOUR_S / 4)**3, 0, 0]))),
    "stands behind an obstacle": (Fault.END, lambda d, v, s: _led_to(
        d, "brake", _places(s, BEHIND_M), s, Status.OCCLUDED)),
    "stands beyond the range": (Fault.END, lambda d, v, s: _led_to(
        d, "brake", _places(s, s.steps[0].view.camera.far_m), s, Status.BEYOND_RANGE)),
    "stands touching an obstacle": (Fault.TOUCHES, lambda d, v, s: _led_to(
        d, "brake", _places(s, 0.1 - s.settings.radius_m), s, Status.FREE)),
    "leads into a hole": (Fault.UNSEEN, lambda d, v, s: _led_to(
        d, "trajectory", _places(s, 0.0, fallback_m=2.0), s, Status.HOLE)),
    "risk above the constraint": (Fault.OVERSTEPS, lambda d, v, s: _with(d, risk=1.5 * s.settings.max_risk)),
    "a third of the motion's risk": (Fault.UNDERSTATES, lambda d, v, s: _with(
        d, risk=d.risk / 3) if v.exact_risk > 1e-6 else None),
    "a third of the brake's risk": (Fault.UNDERSTATES, lambda d, v, s: _with(
        d, brake_risk=d.brake_risk / 3) if v.exact_brake_risk > 1e-6 else None),
    "thrice the brake's risk": (Fault.OVERSTATES, lambda d, v, s: _with(
        d, brake_risk=3 * d.brake_risk) if v.exact_brake_risk > 1e-6 else None),
}


def plant(names: set[str], decision, verified: Verified, pose, start: Start, space: Space) -> dict[str, bool]:
    """Of those faults that the right decision can carry: whether the check sees them."""
    seen = {}
    for name in sorted(names):
        fault, change = PLANTED[name]
        mutant = change(decision, verified, space)
        if mutant is not None:
            seen[name] = any(found == fault for found, _ in verify(mutant, pose, start, space).faults)
    return seen
