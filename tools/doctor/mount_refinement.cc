#include "tools/doctor/mount_refinement.h"

#include <array>
#include <numbers>

namespace nanomap::doctor {
namespace {

constexpr std::array kSteps_deg = {16.0, 8.0, 4.0, 2.0, 1.0};
constexpr int kTurnsOfAStep = 3;

/// The best of six turns by that much, or what it was, if none is better.
JudgedTrial turnedOnce(const std::vector<FramePair>& pairs, const CameraModel& camera, double step_rad,
                       const JudgedTrial& before) {
  JudgedTrial best = before;
  for (const Vec3& axis_B : {Vec3(Vec3::UnitX()), Vec3(Vec3::UnitY()), Vec3(Vec3::UnitZ())}) {
    for (const double turn_rad : {step_rad, -step_rad}) {
      JudgedTrial turned = before;
      turned.trial.T_B_C.rotation = (Eigen::AngleAxisd(turn_rad, axis_B) * before.trial.T_B_C.rotation).normalized();
      turned.agreement = agreement(pairs, camera, turned.trial).value_or(0.0);
      if (turned.agreement > best.agreement) best = turned;
    }
  }
  return best;
}

}  // namespace

JudgedTrial refined(const std::vector<FramePair>& pairs, const CameraModel& camera, JudgedTrial start) {
  JudgedTrial best = start;
  for (const double step_deg : kSteps_deg) {
    for (int turn = 0; turn < kTurnsOfAStep; ++turn) {
      const JudgedTrial next = turnedOnce(pairs, camera, step_deg * std::numbers::pi / 180.0, best);
      if (next.agreement <= best.agreement) break;
      best = next;
    }
  }
  return best;
}

}  // namespace nanomap::doctor
