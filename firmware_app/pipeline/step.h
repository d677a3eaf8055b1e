#pragma once

#include <cstdint>
#include <optional>

#include "core/time.h"
#include "firmware_app/pipeline/message_intake.h"
#include "nanomap/step_t.hpp"

namespace nanomap {

/// One thing that the chain took in. The flight process records them all, and a replay repeats them in their order.
struct Step {
  Time taken{};              ///< when it was taken in
  std::uint64_t number = 0;  ///< 1, 2, 3...
  InputKind kind = InputKind::kPose;
  Time arrival{};          ///< when its message arrived, which together with its channel tells it from all others
  Duration stamp_shift{};  ///< that its stamps were moved by, from their own clock to ours
};

[[nodiscard]] step_t toMessage(const Step& step);

/// Empty if no step can be such.
[[nodiscard]] std::optional<Step> toStep(const step_t& message);

}  // namespace nanomap
