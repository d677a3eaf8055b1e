#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>

#include "core/view.h"
#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "camera";

/// Frames that are not of the camera's size, or of another name.
std::optional<Finding> judgeFrames(const Facts& facts, const CameraModel& camera) {
  for (const DepthInput& frame : facts.heard->frames) {
    const auto fault = faultOf(frame.image, camera);
    if (fault && *fault != ImageFault::kUnitMismatch) {
      return failure(kSubject,
                     fmt::format("frames of {}x{} with {} pixels, a camera of {}x{}: {}", frame.image.width_px,
                                 frame.image.height_px, frame.image.pixels.size(), camera.width(), camera.height(),
                                 toString(*fault)),
                     "give the intrinsics of the stream as it is sent (camera.width_px and the rest)");
    }
    const bool named = !frame.camera.empty() && !facts.configuration.camera;
    if (named && facts.heard->camera->name != frame.camera) {
      return failure(kSubject,
                     fmt::format("frames are of camera '{}', what describes itself is '{}'", frame.camera,
                                 facts.heard->camera->name),
                     "name both alike where they are sent");
    }
  }
  return std::nullopt;
}

/// [camera] against what the camera says of itself.
std::optional<Finding> judgeContradiction(const Facts& facts) {
  constexpr double kFocal = 0.01;
  constexpr double kTurn_rad = 0.05;
  constexpr double kPlace_m = 0.05;
  if (!facts.configuration.camera || !facts.heard->camera) return std::nullopt;
  const CameraParameters& ours = *facts.configuration.camera;
  const CameraParameters& theirs = facts.heard->camera->parameters;
  const double focal = std::abs(ours.fx_px / theirs.fx_px - 1.0);
  const double turn_rad = ours.T_B_C.rotation.angularDistance(theirs.T_B_C.rotation);
  const double place_m = (ours.T_B_C.translation_m - theirs.T_B_C.translation_m).norm();
  if (focal <= kFocal && turn_rad <= kTurn_rad && place_m <= kPlace_m) return std::nullopt;
  return warning(
      kSubject,
      fmt::format("[camera] and the message on '{}' differ: focal length by {:.1f} %, mount by {:.1f} "
                  "degrees and {:.2f} m; [camera] is used",
                  facts.configuration.lcm.camera_channel, focal * 100.0, turn_rad * 180.0 / std::numbers::pi, place_m),
      "mend the one that is wrong, or leave [camera] out");
}

}  // namespace

Findings checkCamera(const Facts& facts) {
  const auto parameters = facts.camera();
  if (!parameters) {
    return {failure(kSubject, "nothing says what the camera is", "write [camera], or send nanomap.camera_model_t")};
  }
  try {
    const CameraModel camera(*parameters);
    if (auto finding = judgeFrames(facts, camera)) return {std::move(*finding)};
  } catch (const std::invalid_argument& error) {  // of a message: [camera] is checked when it is loaded
    return {failure(kSubject, error.what(), "mend what the camera says of itself, or write [camera]")};
  }
  if (auto finding = judgeContradiction(facts)) return {std::move(*finding)};
  return {ok(kSubject, fmt::format("{}x{}, {:g} .. {:g} m, {}", parameters->width_px, parameters->height_px,
                                   parameters->min_range_m, parameters->max_range_m,
                                   facts.configuration.camera ? "by [camera]" : "by its own message"))};
}

}  // namespace nanomap::doctor
