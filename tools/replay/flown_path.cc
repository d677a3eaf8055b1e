#include "tools/replay/flown_path.h"

#include <algorithm>
#include <variant>

#include "firmware_app/pipeline/message_intake.h"

namespace nanomap {
FlownPath::FlownPath(LogReader& log, const std::vector<LogEvent>& events, const Configuration& configuration)
    : poses_(std::max<std::size_t>(events.size(), 1), configuration.chain.max_pose_gap) {
  MessageIntake intake(configuration.lcm);
  std::vector<std::uint8_t> message;
  for (const LogEvent& event : events) {
    if (log.channelOf(event) != configuration.lcm.pose_channel) continue;
    log.read(event, message);
    const auto outcome = intake.read(InputKind::kPose, message);
    if (const auto* input = std::get_if<Input>(&outcome)) (void)poses_.insert(std::get<PoseInput>(*input).pose);
  }
}

std::vector<UncertainPoint> FlownPath::ahead(const ChainSnapshot& snapshot,
                                             const FlownPathParameters& parameters) const {
  const Pose T_B_W = snapshot.T_W_B.inverse();
  std::vector<UncertainPoint> points_B;
  double distance_m = 0.0;
  Vec3 previous_B = Vec3::Zero();
  for (int i = 1; i <= parameters.samples; ++i) {
    const PoseBuffer::Lookup pose = poses_.interpolate(snapshot.stamp + i * parameters.step);
    if (pose.status != PoseBuffer::LookupStatus::kFound || pose.epoch != snapshot.epoch) break;
    const Vec3 p_B = T_B_W * pose.T_W_B.translation_m;
    distance_m += (p_B - previous_B).norm();
    previous_B = p_B;
    points_B.push_back({p_B, parameters.deviation.covariance_m2(distance_m)});
  }
  return points_B;
}

}  // namespace nanomap
