#pragma once

#include <string>
#include <vector>

#include "core/geometry.h"

namespace nanomap::doctor {

/// A camera's mount that differs from the configured one by a mistake that people make.
struct MountTrial {
  Quat R_B_C;
  std::string mistake;  ///< in words
};

/// The rotations of a cube before or after the configured one, and the configured angles with other signs. None is the
/// configured one, no two are alike.
[[nodiscard]] std::vector<MountTrial> mountTrials(const Quat& R_B_C);

}  // namespace nanomap::doctor
