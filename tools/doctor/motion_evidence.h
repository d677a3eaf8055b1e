#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "tools/doctor/agreement.h"
#include "tools/doctor/facts.h"

namespace nanomap::doctor {

/// One thing that may be otherwise than configured, and how well consecutive frames agree then.
struct Hypothesis {
  enum class Kind : std::uint8_t { kAsConfigured, kMount, kDepthUnit, kStamps };
  Kind kind = Kind::kAsConfigured;
  Trial trial;
  Duration stamp_shift{};  ///< on the frames' stamps
  std::string text{};      ///< how the mount is turned, in words
  double agreement = 0.0;  ///< 0 to 1
};

/// What the vehicle's motion tells of camera and stamps.
struct MotionEvidence {
  std::size_t pairs = 0;
  std::optional<Hypothesis> configured{};  ///< empty: the motion tells nothing
  std::vector<Hypothesis> others{};        ///< by descending agreement

  /// The best of the others, if it explains clearly more than what is configured.
  [[nodiscard]] const Hypothesis* better() const;

  /// The best of the others, if it is a mount and explains slightly more at least.
  [[nodiscard]] const Hypothesis* nearbyMount() const;
};

/// Tries the camera as configured, turned by the rotations of a cube, with the signs of its mount's angles changed,
/// with its depth unit off by powers of ten, and with shifted stamps. Threads: a function of its arguments.
[[nodiscard]] MotionEvidence motionEvidence(const Heard& heard, const CameraParameters& camera, Duration max_pose_gap);

}  // namespace nanomap::doctor
