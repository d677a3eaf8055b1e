#include "planner/candidates.h"

#include "core/level_frame.h"
#include "planner/brake.h"

namespace nanomap {

Candidates::Candidates(const PlannerParameters& parameters, const PrimitiveLibrary& library,
                       const ChainSnapshot& snapshot, const Goal& goal, Time start, const Motion& at_start_W,
                       double yaw_W_rad, const Aside& aside, const Trajectory* in_force)
    : parameters_(parameters),
      library_(library),
      space_(snapshot, parameters.risk, aside),
      goal_(goal),
      objective_(parameters.objective, goal, at_start_W.position_m),
      start_(start),
      at_start_W_(at_start_W),
      in_force_(in_force),
      start_evidence_(space_.assess(at_start_W, 0.0)),
      R_W_L_(levelAxes(yaw_W_rad)) {
  space_.lookBeside(at_start_W, start_evidence_);
}

Vec3 Candidates::acceleration_L(std::uint32_t index) const {
  const Vec3& velocity_W = at_start_W_.velocity_m_s;
  if (index < kLibrarySize) return library_.acceleration_L(index, parameters_.limits, velocity_W.norm());
  if (isStop(index)) return Vec3::Zero();
  const Vec3 to_goal_L = R_W_L_.transpose() * (goal_.position_W_m - at_start_W_.position_m);
  return goalDirectedAcceleration(to_goal_L, R_W_L_.transpose() * velocity_W, goal_.top_speed_m_s,
                                  parameters_.goal_directed, parameters_.limits);
}

Trajectory Candidates::motion(std::uint32_t index) const {
  if (index == kBrake) return brakeAfter(Trajectory(start_, at_start_W_), 0.0, parameters_.limits);
  if (index == kBrakeInForce) return *in_force_;
  const PrimitiveTimes times = parameters_.horizon.at(at_start_W_.velocity_m_s.norm());
  return primitive(start_, at_start_W_, R_W_L_ * acceleration_L(index), times, parameters_.limits);
}

Trajectory Candidates::brake(std::uint32_t index) const { return brakeOf(index, motion(index)); }

Trajectory Candidates::brakeOf(std::uint32_t index, const Trajectory& motion) const {
  return isStop(index) ? motion : brakeAfter(motion, parameters_.brake_after_s, parameters_.limits);
}

Proposal Candidates::propose(std::uint32_t index) const {
  const Trajectory trajectory = motion(index);
  const Vec3 standstill_W = brakeOf(index, trajectory).atEnd().position_m;
  double reward = 0.0;
  if (index == kBrake) {
    reward = objective_.brakeReward(standstill_W);
  } else {
    const Vec3 velocity_W = trajectory.sample(parameters_.brake_after_s).velocity_m_s;
    reward = objective_.motionReward(standstill_W, velocity_W.norm());
  }
  return {index, reward};
}

TrajectoryRisk Candidates::assessBrake(std::uint32_t index) const {
  const Trajectory trajectory = brake(index);
  TrajectoryRisk risk = space_.assess(trajectory, parameters_.brake_samples, false, nullptr, &start_evidence_);
  space_.lookBeside(trajectory, parameters_.brake_samples, false, risk);
  return risk;
}

Verdict Candidates::judge(std::uint32_t index, bool stop_early, Evidence* evidence) const {
  Verdict verdict;
  const Trajectory trajectory = motion(index);
  if (stop_early) {
    if (const std::optional<TrajectoryRisk> vetoed = space_.glance(trajectory, parameters_.samples)) {
      verdict.motion = *vetoed;
      verdict.veto = vetoed->veto;
      return verdict;
    }
  }
  verdict.motion = space_.assess(trajectory, parameters_.samples, stop_early,
                                 evidence != nullptr ? &evidence->motion : nullptr, &start_evidence_);
  verdict.veto = verdict.motion.veto;
  if (!verdict.veto && !isStop(index) && !verdict.motion.last.leadsOut()) {
    verdict.veto = VetoCause{verdict.motion.last.status};
  }
  if (verdict.veto || parameters_.stop_check == StopCheck::kPaper) return verdict;

  verdict.stop = isStop(index) ? verdict.motion
                               : space_.assess(brakeOf(index, trajectory), parameters_.brake_samples, stop_early,
                                               evidence != nullptr ? &evidence->brake : nullptr, &start_evidence_);
  verdict.veto = verdict.stop->veto;
  const SampleEvidence& end = verdict.stop->last;
  if (!verdict.veto && !end.seenFree()) verdict.veto = VetoCause{end.status};
  return verdict;
}

void Candidates::lookBeside(std::uint32_t index, bool stop_early, Verdict& verdict, Evidence* evidence) const {
  if (verdict.veto) return;
  const Trajectory trajectory = motion(index);
  space_.lookBeside(trajectory, parameters_.samples, stop_early, verdict.motion,
                    evidence != nullptr ? &evidence->motion : nullptr);
  verdict.veto = verdict.motion.veto;
  if (!verdict.stop) return;
  if (verdict.veto) {
    verdict.stop.reset();
  } else if (isStop(index)) {
    verdict.stop = verdict.motion;
  } else {
    space_.lookBeside(brakeOf(index, trajectory), parameters_.brake_samples, stop_early, *verdict.stop,
                      evidence != nullptr ? &evidence->brake : nullptr);
    verdict.veto = verdict.stop->veto;
  }
}

}  // namespace nanomap
