#include <fmt/format.h>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "body axes";

/// The up component, in W, of the body's z axis, in the middle of all poses that are poses.
double upOfBody(const std::vector<BodyPose>& poses) {
  double sum = 0.0;
  double count = 0.0;
  for (const BodyPose& pose : poses) {
    if (checkPose(pose.T_W_B) != PoseVerdict::kAccepted) continue;
    sum += (pose.T_W_B.rotation * Vec3::UnitZ()).z();
    ++count;
  }
  return count > 0.0 ? sum / count : 0.0;
}

}  // namespace

Findings checkBody(const Facts& facts) {
  constexpr double kUpright = 0.5;  // 60 degrees
  const double up = upOfBody(facts.heard->poses);
  const LcmParameters& lcm = facts.configuration.lcm;
  const std::string seen = fmt::format("the poses' body z has {:+.2f} along the world's up", up);
  if (up > kUpright) return {ok(kSubject, seen)};
  if (up < -kUpright) {
    const HeardChannel* channel = facts.heard->channel(lcm.pose_channel);
    const bool convention_is_ours = channel && channel->type == "bot_core.pose_t";
    const bool flu = lcm.pose_t_body == BodyConvention::kFlu;
    return {failure(kSubject, seen + ": as if it flew upside down",
                    convention_is_ours ? fmt::format("lcm.pose_t_body = \"{}\"", flu ? "frd" : "flu")
                                       : "nanomap.body_pose_t is of forward, left, up: turn it by 180 degrees about x "
                                         "where it is sent")};
  }
  return {failure(kSubject, seen + ": it lies on its side",
                  "the poses may be those of the camera (right, down, forward), or of a world whose z is not up: send "
                  "those of the body, forward, left, up")};
}

}  // namespace nanomap::doctor
