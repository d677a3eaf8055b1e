#include "core/decision.h"

namespace nanomap {

std::string_view toString(Reason reason) {
  switch (reason) {
    case Reason::kFlying:
      return "flying";
    case Reason::kGoingRound:
      return "going round what is in the way";
    case Reason::kKeeping:
      return "nothing new is better: keeping to the verified motion and its brake";
    case Reason::kAtGoal:
      return "at the goal";
    case Reason::kSlowing:
      return "faster than the top speed: slowing down";
    case Reason::kTurning:
      return "the goal is out of view: turning towards it";
    case Reason::kBlocked:
      return "blocked: looking around";
    case Reason::kRetreating:
      return "too near to something: moving away from it";
    case Reason::kNothingVerified:
      return "nothing is safe, not even stopping: keep to the last verified brake";
    case Reason::kNoGoal:
      return "no goal yet: standing still";
    case Reason::kGoalInvalid:
      return "the goal is invalid: standing still";
    case Reason::kGoalOtherEpoch:
      return "the goal is of a world that the estimator has left: standing still";
    case Reason::kNoView:
      return "no depth image yet: standing still";
    case Reason::kStateInvalid:
      return "the vehicle's state is invalid: keep to the last verified brake";
    case Reason::kStateOtherTime:
      return "the vehicle's state is too old or from the future: keep to the last verified brake";
    case Reason::kStateOtherEpoch:
      return "the vehicle's state and the map are of different worlds: keep to the last verified brake";
  }
  return "?";
}

}  // namespace nanomap
