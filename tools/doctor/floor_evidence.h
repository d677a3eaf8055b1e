#pragma once

#include <cstdint>

#include "core/camera_model.h"
#include "core/time.h"
#include "tools/doctor/heard.h"
#include "tools/doctor/plane.h"

namespace nanomap::doctor {

/// What the pictures of a vehicle that stands tell of the camera's mount: the floor is level, and a floor is the
/// largest thing in most pictures of one. Which way the camera looks, seen from above, they do not tell.
struct FloorEvidence {
  enum class Kind : std::uint8_t {
    kNoPicture,  ///< no frame with a pose, or hardly a return in any
    kNoFloor,    ///< no plane that could be one
    kBelow,      ///< a plane below the camera, level or about so: the floor
    kElsewhere,  ///< none below; but a large one beside or above it, seen as a floor would be
    kAmbiguous,  ///< one below, and a larger one elsewhere
  };
  Kind kind = Kind::kNoPicture;
  Plane plane{};  ///< from the camera, in W's axes as the configured mount has them; of the two last, the one elsewhere
  Quat R_W_C = Quat::Identity();  ///< likewise

  /// The turn in W that makes a floor of the plane, and leaves the camera's heading as it is.
  [[nodiscard]] Quat turnToLevel_W() const;
};

/// Looks for the floor in some frames: what most of them show.
/// Threads: a function of its arguments.
[[nodiscard]] FloorEvidence floorEvidence(const Heard& heard, const CameraModel& camera, Duration max_pose_gap);

}  // namespace nanomap::doctor
