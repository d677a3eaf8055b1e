#include "tools/doctor/motion_evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>

#include "tools/doctor/depth_returns.h"
#include "tools/doctor/frame_pairs.h"
#include "tools/doctor/mount_refinement.h"
#include "tools/doctor/mount_trials.h"

namespace nanomap::doctor {
namespace {

constexpr std::size_t kLeastPairs = 4;

/// Powers of ten: units are mistaken for each other by them.
constexpr std::array kDepthFactors = {0.001, 0.01, 0.1, 10.0, 100.0, 1000.0};

constexpr std::array<Duration, 8> kStampShifts = {std::chrono::milliseconds(-400), std::chrono::milliseconds(-200),
                                                  std::chrono::milliseconds(-100), std::chrono::milliseconds(-50),
                                                  std::chrono::milliseconds(50),   std::chrono::milliseconds(100),
                                                  std::chrono::milliseconds(200),  std::chrono::milliseconds(400)};

/// Units under which most depths would lie where the camera measures.
bool isPlausible(const DepthReturns& returns, const CameraParameters& camera, double depth_factor) {
  constexpr double kMost = 0.5;
  return returns.shareInRange(camera, camera.depth_unit_m * depth_factor) >= kMost;
}

std::vector<Hypothesis> hypotheses(const CameraParameters& camera, const DepthReturns& returns) {
  std::vector<Hypothesis> all;
  for (MountTrial& mount : mountTrials(camera.T_B_C.rotation)) {
    all.push_back({.kind = Hypothesis::Kind::kMount,
                   .trial = {{mount.R_B_C, camera.T_B_C.translation_m}},
                   .text = std::move(mount.mistake)});
  }
  for (const double factor : kDepthFactors) {
    if (!isPlausible(returns, camera, factor)) continue;
    all.push_back({.kind = Hypothesis::Kind::kDepthUnit, .trial = {camera.T_B_C, factor}});
  }
  for (const Duration shift : kStampShifts) {
    all.push_back({.kind = Hypothesis::Kind::kStamps, .trial = {camera.T_B_C}, .stamp_shift = shift});
  }
  return all;
}

/// The mount as it fits best near to that of `start`, if that is clearly better.
std::optional<Hypothesis> refinedMount(const std::vector<FramePair>& pairs, const CameraModel& camera,
                                       const Hypothesis& start) {
  constexpr double kWorthIt = 0.03;
  const JudgedTrial fitted = refined(pairs, camera, {start.trial, start.agreement});
  if (fitted.agreement < start.agreement + kWorthIt) return std::nullopt;
  const double turn_rad = fitted.trial.T_B_C.rotation.angularDistance(camera.parameters().T_B_C.rotation);
  return Hypothesis{
      .kind = Hypothesis::Kind::kMount,
      .trial = fitted.trial,
      .text = fmt::format("the camera is turned by about {:.0f} degrees", turn_rad * 180.0 / std::numbers::pi),
      .agreement = fitted.agreement};
}

}  // namespace

const Hypothesis* MotionEvidence::better() const {
  constexpr double kClearlyMore = 0.15;
  constexpr double kHalfTheDoubt = 0.5;
  if (!configured || others.empty()) return nullptr;
  const Hypothesis& best = others.front();
  const bool clearly = best.agreement > configured->agreement + kClearlyMore &&
                       1.0 - best.agreement < kHalfTheDoubt * (1.0 - configured->agreement);
  return clearly ? &best : nullptr;
}

const Hypothesis* MotionEvidence::nearbyMount() const {
  constexpr double kSlightlyMore = 0.04;
  if (!configured || others.empty()) return nullptr;
  const Hypothesis& best = others.front();
  const bool slightly = best.kind == Hypothesis::Kind::kMount && best.agreement > configured->agreement + kSlightlyMore;
  return slightly ? &best : nullptr;
}

MotionEvidence motionEvidence(const Heard& heard, const CameraParameters& parameters, Duration max_pose_gap) {
  const CameraModel camera(parameters);
  const PoseBuffer poses = poseBufferOf(heard, max_pose_gap);
  const std::vector<FramePair> pairs = movedPairs(heard, poses, camera);
  MotionEvidence evidence{.pairs = pairs.size()};
  if (pairs.size() < kLeastPairs) return evidence;

  const Trial as_configured{parameters.T_B_C};
  const auto share = agreement(pairs, camera, as_configured);
  if (!share) return evidence;
  evidence.configured = Hypothesis{.trial = as_configured, .agreement = *share};
  for (Hypothesis& hypothesis : hypotheses(parameters, DepthReturns(heard, camera))) {
    const bool shifted = hypothesis.kind == Hypothesis::Kind::kStamps;
    hypothesis.agreement =
        agreement(shifted ? movedPairs(heard, poses, camera, hypothesis.stamp_shift) : pairs, camera, hypothesis.trial)
            .value_or(0.0);
    evidence.others.push_back(std::move(hypothesis));
  }
  const auto best_mount = std::ranges::max_element(
      evidence.others, {}, [](const Hypothesis& h) { return h.kind == Hypothesis::Kind::kMount ? h.agreement : 0.0; });
  for (const Hypothesis& start : {*evidence.configured, Hypothesis(*best_mount)}) {
    if (auto mount = refinedMount(pairs, camera, start)) evidence.others.push_back(std::move(*mount));
  }
  std::ranges::stable_sort(evidence.others, std::ranges::greater(), &Hypothesis::agreement);
  return evidence;
}

}  // namespace nanomap::doctor
