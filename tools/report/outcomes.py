"""What the planner's reasons come to, and how each looks."""

from enum import Enum

from style import Look


class Outcome(Enum):
    """In the order in which a reader looks for them. Those with a marker are marked on the map."""

    FLYING = Look("flying", "#009E73", "")
    GOING_ROUND = Look("going round", "#8FD3BC", "")
    KEEPING = Look("keeping on", "#7A9A01", "")
    AT_GOAL = Look("at the goal", "#56B4E9", "")
    SLOWING = Look("slowing down", "#0072B2", "v")
    TURNING = Look("turning to the goal", "#CC79A7", "o")
    BLOCKED = Look("blocked", "#E69F00", "s")
    MOVING_AWAY = Look("moving away", "#F0E442", "^")
    NOTHING_VERIFIED = Look("nothing verified", "#000000", "X")
    NO_GOAL = Look("no usable goal", "#9A9A9A", "d")
    NO_VIEW = Look("no view yet", "#C8C8C8", "*")
    NO_STATE = Look("no usable state", "#D55E00", "P")
    OTHER = Look("other", "#4D4D4D", "h")


# core/decision.cc, in its order.
OUTCOMES = {
    "flying": Outcome.FLYING,
    "going round what is in the way": Outcome.GOING_ROUND,
    "nothing new is better: keeping to the verified motion and its brake": Outcome.KEEPING,
    "at the goal": Outcome.AT_GOAL,
    "faster than the top speed: slowing down": Outcome.SLOWING,
    "the goal is out of view: turning towards it": Outcome.TURNING,
    "blocked: looking around": Outcome.BLOCKED,
    "too near to something: moving away from it": Outcome.MOVING_AWAY,
    "nothing is safe, not even stopping: keep to the last verified brake": Outcome.NOTHING_VERIFIED,
    "no goal yet: standing still": Outcome.NO_GOAL,
    "the goal is invalid: standing still": Outcome.NO_GOAL,
    "the goal is of a world that the estimator has left: standing still": Outcome.NO_GOAL,
    "no depth image yet: standing still": Outcome.NO_VIEW,
    "the vehicle's state is invalid: keep to the last verified brake": Outcome.NO_STATE,
    "the vehicle's state is too old or from the future: keep to the last verified brake": Outcome.NO_STATE,
    "the vehicle's state and the map are of different worlds: keep to the last verified brake": Outcome.NO_STATE,
}


def outcome(decision) -> Outcome:
    return OUTCOMES.get(decision.reason, Outcome.OTHER)
