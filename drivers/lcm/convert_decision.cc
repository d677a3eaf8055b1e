#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

void store(const Vec3& from, double (&xyz)[3]) { Vec3::Map(xyz) = from; }

}  // namespace

Converted<Goal> toGoal(const goal_t& message) {
  const Converted<Time> stamp = timeFromUtime(message.utime);
  if (const auto* fault = std::get_if<ConvertFault>(&stamp)) return *fault;
  if (message.sequence < 0) return ConvertFault::kBadSequence;
  if (message.epoch < 0) return ConvertFault::kBadEpoch;

  Goal goal;
  goal.stamp = std::get<Time>(stamp);
  goal.sequence = static_cast<std::uint64_t>(message.sequence);
  goal.epoch = static_cast<std::uint32_t>(message.epoch);
  goal.position_W_m = Vec3::Map(message.position);
  goal.top_speed_m_s = message.top_speed;
  return goal;
}

trajectory_t toMessage(const Trajectory& trajectory) {
  trajectory_t message{};
  message.utime = utimeFromTime(trajectory.start());
  store(trajectory.atStart().position_m, message.position);
  store(trajectory.atStart().velocity_m_s, message.velocity);
  store(trajectory.atStart().acceleration_m_s2, message.acceleration);
  message.num_pieces = static_cast<std::int32_t>(trajectory.pieces().size());
  for (const Trajectory::Piece& piece : trajectory.pieces()) {
    message.piece_duration.push_back(piece.duration_s);
    const Vec3& jerk = piece.jerk_W_m_s3;
    message.piece_jerk.push_back({jerk.x(), jerk.y(), jerk.z()});
  }
  return message;
}

decision_t toMessage(const Decision& decision, const DecisionPlace& place) {
  decision_t message{};
  message.utime = utimeFromTime(decision.stamp);
  message.sequence = static_cast<std::int64_t>(place.sequence);
  message.step = static_cast<std::int64_t>(place.step);
  message.flown = place.flown ? 1 : 0;

  const Consumed& consumed = decision.consumed;
  message.state_sequence = static_cast<std::int64_t>(consumed.state_sequence);
  message.pose_sequence = static_cast<std::int64_t>(consumed.pose_sequence);
  message.epoch = static_cast<std::int32_t>(consumed.epoch);
  message.num_views = static_cast<std::int32_t>(consumed.view_count);
  message.has_view = consumed.newest_view_sequence.has_value() ? 1 : 0;
  message.newest_view_sequence = static_cast<std::int64_t>(consumed.newest_view_sequence.value_or(0));
  message.has_correction = consumed.correction_sequence.has_value() ? 1 : 0;
  message.correction_sequence = static_cast<std::int64_t>(consumed.correction_sequence.value_or(0));
  message.has_goal = consumed.goal_sequence.has_value() ? 1 : 0;
  message.goal_sequence = static_cast<std::int64_t>(consumed.goal_sequence.value_or(0));

  message.reason = toString(decision.reason);
  message.has_motion = decision.candidate.has_value() ? 1 : 0;
  message.primitive = static_cast<std::int32_t>(decision.candidate.value_or(0));
  message.trajectory = toMessage(decision.trajectory);
  message.yaw = decision.yaw_W_rad;
  message.yaw_rate = decision.yaw_rate_rad_s;
  message.risk = decision.risk;
  message.has_brake = decision.brake_verified ? 1 : 0;
  message.brake = toMessage(decision.brake);
  message.brake_risk = decision.brake_risk;

  message.num_candidates = static_cast<std::int32_t>(decision.candidates);
  message.num_evaluated = static_cast<std::int32_t>(decision.evaluated);
  message.num_feasible = static_cast<std::int32_t>(decision.feasible);
  message.num_statuses = static_cast<std::int32_t>(kStatusCount);
  for (const std::uint32_t count : decision.vetoes.by_status) {
    message.vetoes.push_back(static_cast<std::int32_t>(count));
  }
  message.vetoes_neighbours = static_cast<std::int32_t>(decision.vetoes.by_neighbours);
  message.vetoes_of_brakes = static_cast<std::int32_t>(decision.vetoes.of_brakes);
  return message;
}

}  // namespace nanomap
