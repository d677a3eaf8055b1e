#include "planner/planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "core/level_frame.h"
#include "planner/candidates.h"
#include "planner/heading.h"
#include "planner/input_check.h"
#include "planner/retreat.h"

namespace nanomap {
namespace {

/// The inputs of one plan.
struct Inputs {
  const ChainSnapshot& snapshot;
  const VehicleState& state;
  const std::optional<Goal>& goal;
  Time now;
  const InForce& in_force;
};

Consumed consumed(const Inputs& inputs) {
  Consumed consumed;
  consumed.epoch = inputs.state.epoch;
  consumed.state_sequence = inputs.state.sequence;
  consumed.pose_sequence = inputs.snapshot.pose_sequence;
  consumed.correction_sequence = inputs.snapshot.correction_sequence;
  const std::vector<SnapshotView>& views = inputs.snapshot.views;
  if (!views.empty()) consumed.newest_view_sequence = views.front().view->sequence();
  consumed.view_count = static_cast<std::uint32_t>(views.size());
  if (inputs.goal) consumed.goal_sequence = inputs.goal->sequence;
  return consumed;
}

/// The state, carried on to `now` at constant acceleration.
Motion motionNow(const Inputs& inputs) {
  const VehicleState& state = inputs.state;
  const Motion at_stamp{state.T_W_B.translation_m, state.velocity_W_m_s, state.acceleration_W_m_s2};
  return advance(at_stamp, Vec3::Zero(), toSeconds(inputs.now - state.stamp));
}

/// A plan that the state allows: what to choose from, and towards what.
struct Task {
  Motion at_start_W;
  double yaw_W_rad;
  std::optional<Reason> hold;  ///< why stopping is all that is considered
  Goal goal;                   ///< to hold: the place where the vehicle is
  Candidates candidates;

  [[nodiscard]] std::uint32_t firstCandidate() const { return hold ? kBrake : 0; }
};

/// @pre the state has no fault
Task taskOf(const PlannerParameters& parameters, const PrimitiveLibrary& library, const Inputs& inputs) {
  const Motion at_start_W = motionNow(inputs);
  const double yaw_W_rad = yawOf(inputs.state.T_W_B.rotation);
  const std::optional<Reason> hold =
      inputs.snapshot.views.empty() ? Reason::kNoView : goalFault(inputs.goal, inputs.state);
  Goal goal;
  goal.position_W_m = at_start_W.position_m;
  if (!hold) {
    goal = *inputs.goal;
    goal.top_speed_m_s = std::min(goal.top_speed_m_s, parameters.limits.top_speed_m_s);
  }
  return {at_start_W, yaw_W_rad, hold, goal,
          Candidates(parameters, library, inputs.snapshot, goal, inputs.now, at_start_W, yaw_W_rad,
                     {inputs.in_force.aside_W_m, parameters.tracking.recovery_s}, inputs.in_force.rest)};
}

struct Choice {
  std::uint32_t index = 0;
  double objective = 0.0;
  Verdict verdict;
};

/// The higher objective; of equal ones the lower index.
bool isBetter(const Choice& choice, const Choice& other) {
  return choice.objective > other.objective || (choice.objective == other.objective && choice.index < other.index);
}

void count(const Verdict& verdict, Decision& decision) {
  if (!verdict.veto) {
    ++decision.feasible;
    return;
  }
  ++(verdict.veto->status ? decision.vetoes.by_status[static_cast<std::size_t>(*verdict.veto->status)]
                          : decision.vetoes.by_neighbours);
  if (verdict.vetoedByBrake()) ++decision.vetoes.of_brakes;
}

/// The best of the feasible candidates. Counts into `decision`.
std::optional<Choice> choose(const Task& task, bool early_exit, Decision& decision) {
  std::array<Proposal, kMostCandidates> storage;
  const std::span proposals = std::span(storage).first(task.candidates.count()).subspan(task.firstCandidate());
  for (std::uint32_t index = task.firstCandidate(); index < task.candidates.count(); ++index) {
    storage[index] = task.candidates.propose(index);
  }
  std::sort(proposals.begin(), proposals.end(), [](const Proposal& a, const Proposal& b) {
    return a.reward != b.reward ? a.reward > b.reward : a.index < b.index;
  });

  decision.candidates = static_cast<std::uint32_t>(proposals.size());
  std::optional<Choice> best;
  for (const Proposal& proposal : proposals) {
    if (early_exit && best && proposal.reward < best->objective) break;
    Choice choice{proposal.index, 0.0, task.candidates.judge(proposal.index, early_exit)};
    ++decision.evaluated;
    const auto isBest = [&] {
      if (choice.verdict.veto) return false;
      choice.objective = task.candidates.objective().value(proposal.reward, choice.verdict.motion.risk);
      return !best || isBetter(choice, *best);
    };
    // What other views know makes nothing better: only what would be the best gets a second look.
    if (isBest()) {
      task.candidates.lookBeside(choice.index, early_exit, choice.verdict);
      if (isBest()) best = choice;
    }
    count(choice.verdict, decision);
  }
  return best;
}

/// Why a vehicle stops that could go for its goal, before any look at where the camera points.
Reason stopReason(const Task& task, const Decision& decision) {
  if (task.candidates.objective().isAtGoal(decision.brake.atEnd().position_m)) return Reason::kAtGoal;
  if (decision.candidate == kBrakeInForce) return Reason::kKeeping;
  if (task.at_start_W.velocity_m_s.norm() > task.goal.top_speed_m_s) return Reason::kSlowing;
  return Reason::kBlocked;
}

/// Where the camera is to look, as a heading of the body; a reason for stopping is refined by what that tells.
double wantedHeading(const PlannerParameters& parameters, const Inputs& inputs, const Task& task, Decision& decision) {
  if (task.hold) return task.yaw_W_rad;
  const HorizontalView view = horizontalView(inputs.snapshot.views.front().view->camera());
  const auto headingTo = [&](const Vec3& direction_W) {
    return std::atan2(direction_W.y(), direction_W.x()) - view.yaw_B_rad;
  };
  const Vec3 to_goal_W = task.goal.position_W_m - task.at_start_W.position_m;
  const bool above_or_below = to_goal_W.head<2>().norm() <= parameters.objective.goal_tolerance_m;
  const double goal_heading_rad = above_or_below ? task.yaw_W_rad : headingTo(to_goal_W);

  const Vec3 velocity_W = decision.trajectory.sample(parameters.brake_after_s).velocity_m_s;
  const bool moves = velocity_W.head<2>().norm() >= parameters.heading.min_speed_m_s;
  const bool brakes = isStop(*decision.candidate);

  switch (decision.reason) {
    case Reason::kFlying:
    case Reason::kKeeping:
      return moves ? headingTo(velocity_W) : goal_heading_rad;
    case Reason::kBlocked:
    case Reason::kRetreating:
    case Reason::kNothingVerified: {
      // What it comes to a stand before was best seen just now: what is looked away from soon is too near.
      if (moves && brakes) return headingTo(velocity_W);
      // What a sweep reaches anyway need not be turned to first, else the two would take turns.
      const double reach_rad = std::max(view.half_width_rad, parameters.heading.sweep_amplitude_rad);
      const bool out_of_reach = std::abs(wrapAngle(goal_heading_rad - task.yaw_W_rad)) > reach_rad;
      if (!out_of_reach) return goal_heading_rad + sweepOffset(inputs.now, parameters.heading);
      if (decision.reason == Reason::kBlocked) decision.reason = Reason::kTurning;
      return goal_heading_rad;
    }
    default:
      return goal_heading_rad;
  }
}

}  // namespace

Planner::Planner(const PlannerParameters& parameters) : parameters_(parameters) { check(parameters_); }

Decision Planner::plan(const ChainSnapshot& snapshot, const VehicleState& state, const std::optional<Goal>& goal,
                       Time now, const InForce& in_force) const {
  const Inputs inputs{snapshot, state, goal, now, in_force};
  Decision decision;
  decision.stamp = now;
  decision.consumed = consumed(inputs);
  if (const auto fault = stateFault(state, snapshot, now, parameters_.max_state_age)) {
    decision.reason = *fault;
    return decision;
  }
  const Task task = taskOf(parameters_, library_, inputs);
  const std::optional<Choice> choice = choose(task, parameters_.early_exit, decision);

  const std::optional<Retreat> retreat = choice ? std::nullopt : chooseRetreat(task.candidates, parameters_);

  decision.candidate = choice ? choice->index : retreat ? retreat->index : kBrake;
  decision.trajectory = task.candidates.motion(*decision.candidate);
  decision.brake = task.candidates.brake(*decision.candidate);
  if (choice) {
    decision.risk = choice->verdict.motion.risk;
    decision.brake_verified = choice->verdict.stop.has_value();
    if (choice->verdict.stop) decision.brake_risk = choice->verdict.stop->risk;
  }
  if (retreat) {
    decision.risk = retreat->brake.risk;
    decision.reason = Reason::kRetreating;
  } else if (!choice) {
    decision.reason = Reason::kNothingVerified;
  } else if (task.hold) {
    decision.reason = *task.hold;
  } else {
    decision.reason = isStop(choice->index) ? stopReason(task, decision) : Reason::kFlying;
  }

  const double heading_W_rad = wantedHeading(parameters_, inputs, task, decision);
  const HeadingCommand command = turn(task.yaw_W_rad, heading_W_rad, parameters_.heading);
  decision.yaw_W_rad = command.yaw_W_rad;
  decision.yaw_rate_rad_s = command.rate_rad_s;
  return decision;
}

Explanation Planner::explain(const ChainSnapshot& snapshot, const VehicleState& state, const std::optional<Goal>& goal,
                             Time now, const InForce& in_force) const {
  Explanation explanation;
  explanation.decision = plan(snapshot, state, goal, now, in_force);
  if (!explanation.decision.candidate) return explanation;

  const Task task = taskOf(parameters_, library_, {snapshot, state, goal, now, in_force});
  for (std::uint32_t index = task.firstCandidate(); index < task.candidates.count(); ++index) {
    CandidateExplanation candidate;
    candidate.proposal = task.candidates.propose(index);
    candidate.acceleration_L_m_s2 = task.candidates.acceleration_L(index);
    candidate.trajectory = task.candidates.motion(index);
    candidate.brake = task.candidates.brake(index);
    candidate.verdict = task.candidates.judge(index, false, &candidate.evidence);
    task.candidates.lookBeside(index, false, candidate.verdict, &candidate.evidence);
    candidate.objective = task.candidates.objective().value(candidate.proposal.reward, candidate.verdict.motion.risk);
    explanation.candidates.push_back(std::move(candidate));
  }
  return explanation;
}

}  // namespace nanomap
