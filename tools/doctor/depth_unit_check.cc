#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "core/camera_model.h"
#include "core/view.h"
#include "tools/doctor/checks.h"
#include "tools/doctor/depth_returns.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "depth unit";

/// What units are mistaken by; of those that explain as much, the first is named.
constexpr std::array kPowers = {0.1, 10.0, 0.01, 100.0, 0.001, 1000.0};

std::optional<Finding> judgeContradiction(const Facts& facts, const CameraParameters& camera,
                                          const CameraModel& model) {
  const std::string source = facts.configuration.camera ? "[camera]" : "the camera's message";
  for (const DepthInput& frame : facts.heard->frames) {
    if (faultOf(frame.image, model) != ImageFault::kUnitMismatch) continue;
    return failure(kSubject,
                   fmt::format("frames have {:g} m a count, {} says {:g}: every frame is refused",
                               frame.image.depth_unit_m, source, camera.depth_unit_m),
                   fmt::format("camera.depth_unit_m = {:g}, if the frames are right", frame.image.depth_unit_m));
  }
  return std::nullopt;
}

/// Depths that no camera of that range would measure, most of them.
std::optional<Finding> judgeDistribution(const CameraParameters& camera, const DepthReturns& returns) {
  constexpr double kImplausible = 0.05;
  constexpr double kPlausible = 0.5;
  const double share = returns.shareInRange(camera, camera.depth_unit_m);
  if (share >= kImplausible) return std::nullopt;
  const auto* const best = std::ranges::max_element(
      kPowers, {}, [&](double power) { return returns.shareInRange(camera, camera.depth_unit_m * power); });
  const double best_unit_m = camera.depth_unit_m * *best;
  const double best_share = returns.shareInRange(camera, best_unit_m);
  const std::string seen =
      fmt::format("{:.0f} % of the depths are within {:g} .. {:g} m, their median is {:.3g} m", share * 100.0,
                  camera.min_range_m, camera.max_range_m, returns.median_m(camera.depth_unit_m));
  if (best_share < kPlausible) {
    return warning(kSubject, seen, "check camera.min_range_m, camera.max_range_m and what the camera looks at");
  }
  return failure(kSubject, seen,
                 fmt::format("camera.depth_unit_m = {:g}, with which {:.0f} % are; the frames must say so too",
                             best_unit_m, best_share * 100.0));
}

}  // namespace

Findings checkDepthUnit(const Facts& facts, const MotionEvidence* evidence) {
  const auto camera = facts.camera();
  if (!camera || facts.heard->frames.empty()) return {notLookedAt(kSubject, "no frames, or no camera")};
  const CameraModel model(*camera);
  if (auto finding = judgeContradiction(facts, *camera, model)) return {std::move(*finding)};
  const DepthReturns returns(*facts.heard, model);
  if (returns.empty()) {
    return {warning(kSubject, fmt::format("{} frames without any depth", facts.heard->frames.size()),
                    "look at what the camera sends: covered, too near, or another value for 'no depth' "
                    "(camera.no_return_values)")};
  }
  if (auto finding = judgeDistribution(*camera, returns)) return {std::move(*finding)};
  const Hypothesis* better = evidence ? evidence->better() : nullptr;
  if (better && better->kind == Hypothesis::Kind::kDepthUnit) {
    return {failure(kSubject,
                    fmt::format("{:g} m a count: as the vehicle moves, {:.0f} % of the depths agree with those before, "
                                "with {:g} m {:.0f} %",
                                camera->depth_unit_m, evidence->configured->agreement * 100.0,
                                camera->depth_unit_m * better->trial.depth_factor, better->agreement * 100.0),
                    fmt::format("camera.depth_unit_m = {:g}; the frames must say so too",
                                camera->depth_unit_m * better->trial.depth_factor))};
  }
  return {ok(kSubject, fmt::format("{:g} m a count: median depth {:.2f} m, {:.0f} % within {:g} .. {:g} m",
                                   camera->depth_unit_m, returns.median_m(camera->depth_unit_m),
                                   returns.shareInRange(*camera, camera->depth_unit_m) * 100.0, camera->min_range_m,
                                   camera->max_range_m))};
}

}  // namespace nanomap::doctor
