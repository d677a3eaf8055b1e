#include "firmware_app/stages/plan_stage.h"

namespace nanomap {

namespace {

/// Clocks of the same time differ a little: a state that is ahead of ours by less is planned from as if it were now.
Time timeToPlanFor(const VehicleState& state, Time now, Duration max_state_lead) {
  const Time whole = std::chrono::floor<std::chrono::microseconds>(now);
  return state.stamp > whole && state.stamp - whole <= max_state_lead ? state.stamp : whole;
}

}  // namespace

PlanStage::PlanStage(const PlannerParameters& parameters, Duration max_state_lead, const PlanPorts& ports)
    : horizon_(parameters), max_state_lead_(max_state_lead), ports_(ports) {}

bool PlanStage::run(Time now) {
  const bool planned = ports_.moments.take([&](const PlanningMoment& moment) {
    made_.flown = ports_.flown.load(std::memory_order_relaxed);
    if (!made_.flown) horizon_.release();
    made_.decision =
        horizon_.step(moment.snapshot, moment.state, moment.goal, timeToPlanFor(moment.state, now, max_state_lead_));
    made_.step = moment.step;
    newest_view_ = moment.newest_view;
    newest_frame_ = moment.newest_frame;
    made_.sequence = next_sequence_++;
  });
  if (!planned) return false;
  if (isFlyable(made_.decision)) in_force_sequence_ = made_.sequence;
  ports_.plans.put([this](PlanReport& slot) {
    slot = {horizon_.inForce(), in_force_sequence_, newest_view_, made_.decision.reason};
  });
  ports_.decisions.push([this](MadeDecision& slot) { slot = made_; });
  ports_.newest.put([this](MadeDecision& slot) { slot = made_; });
  return true;
}

}  // namespace nanomap
