#pragma once

#include <cstdint>
#include <optional>

#include "planner/explanation.h"
#include "tools/replay/moment.h"
#include "tools/replay/text.h"

namespace nanomap {

/// An explanation as tables: the decision, every candidate from the best objective down, and every sample of one
/// candidate's motion and brake, with the view that answered for it.
/// @param moment     what was planned from
/// @param candidate  whose samples; empty: those of the one chosen
void writeExplanation(Text& text, const Explanation& explanation, const Moment& moment,
                      std::optional<std::uint32_t> candidate);

}  // namespace nanomap
