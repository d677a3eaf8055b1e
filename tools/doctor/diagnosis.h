#pragma once

#include "tools/doctor/checks.h"

namespace nanomap::doctor {

/// Every check, in the order in which a person would mend things. What rests on something that has failed is not looked
/// at: one mistake is one finding. Threads: a function of its arguments.
[[nodiscard]] Findings diagnose(const Facts& facts);

}  // namespace nanomap::doctor
