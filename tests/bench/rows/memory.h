#pragma once

#include <cstddef>
#include <string>

#include "tests/bench/frames/recorded_flight.h"
#include "tests/bench/report/scoreboard.h"

namespace nanomap::bench {

/// The heap, as the allocator accounts for it, that a full history takes: camera, views, chain and a snapshot. The same
/// for the trees of the references is remarked.
void rateMemory(const RecordedFlight& flight, std::size_t history, Scoreboard& scoreboard, const std::string& where);

}  // namespace nanomap::bench
