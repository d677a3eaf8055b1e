#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/replay/replay.h"

namespace nanomap {

/// The plan to be explained: the first of the replay at or after a log time.
struct WhyQuestion {
  Duration at{};                             ///< after the log's first event
  std::optional<std::uint32_t> candidate{};  ///< whose samples are wanted; empty: those of the one chosen
};

/// Runs the log up to that plan and explains it, as text.
/// @throws std::runtime_error if no plan is made at or after that time in the options' span, or the plan has no such
///         candidate; else as replay()
[[nodiscard]] std::string why(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                              const WhyQuestion& question);

}  // namespace nanomap
