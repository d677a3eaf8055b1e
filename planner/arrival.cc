#include "planner/arrival.h"

namespace nanomap {
namespace {

/// Of the tolerance: more than noise and a second's drift, and less than anyone moves a goal by who means it.
constexpr double kLeavesBeyond = 1.5;

}  // namespace

Goal Arrival::steer(const Goal& goal) {
  const bool stays = arrived_ && arrived_->epoch == goal.epoch &&
                     (goal.position_W_m - arrived_->position_W_m).norm() <= kLeavesBeyond * tolerance_m_;
  if (!stays) {
    arrived_.reset();
    return goal;
  }
  Goal here = goal;
  here.position_W_m = arrived_->position_W_m;
  return here;
}

void Arrival::note(const Decision& decision) {
  if (decision.reason != Reason::kAtGoal || arrived_) return;
  arrived_ = Place{decision.brake.atEnd().position_m, decision.consumed.epoch};
}

}  // namespace nanomap
