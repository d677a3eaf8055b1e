#pragma once

#include "tools/replay/plan_statistics.h"
#include "tools/replay/text.h"

namespace nanomap {

/// What was decided, at what risk, and what refused the rest.
void writePlans(Text& text, const PlanStatistics& plans);

}  // namespace nanomap
