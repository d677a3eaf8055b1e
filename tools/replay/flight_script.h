#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/step.h"

namespace nanomap {

/// Something that a recording lacks: from then on a replay may decide otherwise than was decided in flight.
struct RecordingLoss {
  Time at{};         ///< log time
  std::string what;  ///< in words
};

/// When a decision was made in flight.
struct RecordedPlan {
  Time log_stamp{};
  Time now{};  ///< the time planned for
  std::uint64_t sequence = 0;
  std::uint64_t step = 0;  ///< the last one before it
  bool flown = true;       ///< the vehicle was flown by these decisions
};

/// What the flight process did, and in which order, as its recording tells.
struct FlightScript {
  std::vector<Step> steps;            ///< by number, each once; empty: no recording of the flight process
  std::vector<RecordedPlan> plans;    ///< by sequence, each once
  std::vector<RecordingLoss> losses;  ///< by time
};

/// Gaps in the numbers of steps and decisions are losses, and so is what the recorder itself says it lost.
/// @throws std::runtime_error if the log holds the steps of two flights; LogError if it cannot be read
[[nodiscard]] FlightScript readFlightScript(LogReader& log, const LcmParameters& lcm);

}  // namespace nanomap
