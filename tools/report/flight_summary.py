"""A flight and its decisions in a few figures."""

from collections import Counter
from dataclasses import dataclass

import numpy as np
from flight import Flight
from inputs import US_PER_S
from outcomes import Outcome, outcome


@dataclass(frozen=True)
class Summary:
    duration_s: float
    distance_m: float
    top_speed_m_s: float
    plans: int
    by_outcome: Counter  # Outcome -> plans
    max_flown_risk: float | None  # of the motions of plans that fly; None: there are none
    unverified: int  # of those, the ones without a verified brake

    def share(self, of: Outcome) -> float:
        return self.by_outcome[of] / self.plans

    def words(self) -> str:
        flying = (f"{self.distance_m:.0f} m flown in {self.duration_s:.1f} s, top speed {self.top_speed_m_s:.1f} m/s. "
                  f"{100 * self.share(Outcome.FLYING):.0f} % of {self.plans:,} plans flying")
        if self.max_flown_risk is None:
            return flying + "."
        brakes = ("every one with a verified brake" if self.unverified == 0 else
                  f"{self.unverified:,} of them without a verified brake")
        return f"{flying}, {brakes}, risk {self.max_flown_risk:.1e} at most."


def summarise(flight: Flight) -> Summary:
    tracks = flight.tracks.values()
    first, last = flight.utime_range()
    flown = [d for d in flight.decisions if outcome(d) is Outcome.FLYING]
    return Summary(
        duration_s=float(last - first) / US_PER_S,
        distance_m=sum(track.length_m for track in tracks),
        top_speed_m_s=float(np.nanmax(np.concatenate([track.speeds for track in tracks]))),
        plans=len(flight.decisions),
        by_outcome=Counter(map(outcome, flight.decisions)),
        max_flown_risk=max((d.risk for d in flown), default=None),
        unverified=sum(not d.has_brake for d in flown),
    )
