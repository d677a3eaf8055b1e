"""The chain of views, edge by edge, as the paper (IV.B) and DESIGN.md describe it. Slow and plain on purpose."""

from dataclasses import dataclass

import numpy as np
import rigid
from poses import BetweenWorlds, CorrectionWindow, PoseGap, PoseHistory
from settings import US_PER_S, Settings
from view import View


@dataclass
class Place:
    """A moment of the vehicle: where the estimator put it, and where the last correction that reached it does."""

    utime: int
    epoch: int
    T_W_B_original: np.ndarray
    T_W_B: np.ndarray
    world: int  # epoch that T_W_B is given in
    correction: int = 0  # count of the correction that T_W_B comes from


@dataclass
class Link:
    view: View
    place: Place
    T_this_newer: np.ndarray | None = None  # between cameras; None at the newest view, and where a jump cut the chain
    drift_to_newer_W: np.ndarray | None = None  # m^2, from the messages' increments; None: by the law


@dataclass(frozen=True)
class Step:
    """One step of a query, from the newer frame to a view's camera."""

    view: View
    T_C_newer: np.ndarray
    covariance: np.ndarray  # m^2, in C


class Chain:
    def __init__(self, settings: Settings):
        self.settings = settings
        self.poses = PoseHistory(settings.pose_capacity, settings.max_pose_gap_us)
        self.links: list[Link] = []  # newest first
        self.waiting: list[View] = []  # oldest first
        self.window: CorrectionWindow | None = None
        self.corrections = 0
        self.last_correction = (-1, -1)  # epoch, sequence

    def add_pose(self, message) -> int:
        """Returns how many views it let in."""
        if not self.poses.insert(message):
            return 0
        inserted = 0
        while self.waiting and self.waiting[0].utime <= self.poses.newest.utime:
            inserted += self._admit(self.waiting.pop(0))
        return inserted

    def add_view(self, view: View) -> int:
        """Returns 1 if it is in the chain now, else 0."""
        held = [link.view for link in self.links[:1]] + self.waiting
        if any(view.utime == other.utime for other in held):
            return 0
        if len(self.poses) and view.utime <= self.poses.newest.utime:
            return self._admit(view)
        if self.links and view.utime < self.links[0].view.utime:
            return 0
        if len(self.poses) and view.utime > self.poses.newest.utime + self.settings.max_lead_us:
            return 0
        self.waiting = sorted([*self.waiting, view], key=lambda v: v.utime)[-self.settings.waiting_views:]
        return 0

    def add_correction(self, message) -> None:
        stamps = [pose.utime for pose in message.poses]
        if not stamps or any(b <= a for a, b in zip(stamps, stamps[1:])):
            return
        if len(self.poses) and message.epoch < self.poses.newest.epoch:
            return
        if (message.epoch, message.sequence) <= self.last_correction:
            return
        window = CorrectionWindow(message, self.poses)
        if not window.anchors:
            return
        self.window, self.last_correction = window, (message.epoch, message.sequence)
        self.corrections += 1
        for link in self.links:
            self._correct(link.place)
        for newer, older in zip(self.links, self.links[1:]):
            both_inside = all(end.place.correction == self.corrections and window.reaches_inside(end.view.utime)
                              for end in (newer, older))
            if both_inside or older.T_this_newer is None:
                older.T_this_newer = self._edge(older, newer)

    def steps(self) -> list[Step]:
        """The way of a query from the body at the newest pose through every view that can be reached."""
        if not self.links:
            return []
        pose = self.poses.newest
        body = self._place(pose.utime, pose.T_W_B, pose.epoch)
        steps = []
        newer_utime = body.utime
        for i, link in enumerate(self.links):
            if i == 0:
                T_older_B = self._motion(link.place, body)
                T_C_newer = None if T_older_B is None else rigid.inverse(link.view.camera.T_B_C) @ T_older_B
            else:
                T_C_newer = link.T_this_newer
            if T_C_newer is None:
                break
            drift_W = link.drift_to_newer_W if i > 0 else self._increments(link.view.utime, body.utime)
            if drift_W is None:
                older, newer = (self._variance(body.utime - utime) for utime in (link.view.utime, newer_utime))
                drift_W = np.diag(older - newer)
            R_C_W = (link.place.T_W_B_original @ link.view.camera.T_B_C)[:3, :3].T
            steps.append(Step(link.view, T_C_newer, R_C_W @ drift_W @ R_C_W.T))
            newer_utime = link.view.utime
        return steps

    def _admit(self, view: View) -> int:
        if self.links and view.utime < self.links[0].view.utime:
            return 0
        if not self.poses.covers(view.utime):
            return 0
        try:
            T_W_B, epoch = self.poses.at(view.utime)
        except (BetweenWorlds, PoseGap):
            return 0
        self.links.insert(0, Link(view, self._place(view.utime, T_W_B, epoch)))
        del self.links[self.settings.history_views:]
        if len(self.links) > 1:
            self.links[1].T_this_newer = self._edge(self.links[1], self.links[0])
            self.links[1].drift_to_newer_W = self._increments(self.links[1].view.utime, view.utime)
        return 1

    def _place(self, utime: int, T_W_B: np.ndarray, epoch: int) -> Place:
        place = Place(utime, epoch, T_W_B, T_W_B, epoch)
        self._correct(place)
        return place

    def _correct(self, place: Place) -> None:
        delta = self.window.delta(place.utime, place.epoch) if self.window else None
        if delta is not None:
            place.T_W_B = delta @ place.T_W_B_original
            place.world = self.window.epoch
            place.correction = self.corrections

    @staticmethod
    def _motion(older: Place, newer: Place) -> np.ndarray | None:
        """T_Bolder_Bnewer; None if the world jumped between the two and no correction tells how."""
        if older.world == newer.world and (older.correction == newer.correction or older.epoch != newer.epoch):
            return rigid.inverse(older.T_W_B) @ newer.T_W_B
        if older.epoch == newer.epoch:
            return rigid.inverse(older.T_W_B_original) @ newer.T_W_B_original
        return None

    def _edge(self, older: Link, newer: Link) -> np.ndarray | None:
        T_older_newer = self._motion(older.place, newer.place)
        if T_older_newer is None:
            return None
        return rigid.inverse(older.view.camera.T_B_C) @ T_older_newer @ newer.view.camera.T_B_C

    def _increments(self, older_utime: int, newer_utime: int) -> np.ndarray | None:
        return self.poses.drift(older_utime, newer_utime) if self.settings.use_increments else None

    def _variance(self, age_us: int) -> np.ndarray:
        """Diagonal in W [m^2] of the drift of relative position after a time."""
        share = max(age_us, 0) / US_PER_S / self.settings.after_s
        growth = share**2 if self.settings.linear_growth else share
        std = np.array([self.settings.horizontal_std_m, self.settings.horizontal_std_m, self.settings.vertical_std_m])
        return growth * std**2
