#pragma once

#include <string>

#include "core/geometry.h"
#include "tools/doctor/facts.h"

namespace nanomap::doctor {

/// What to write so that the camera is mounted like that, where it is written now: key or message, and the values.
[[nodiscard]] std::string mountFix(const Facts& facts, const Quat& R_B_C);

}  // namespace nanomap::doctor
