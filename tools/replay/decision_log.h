#pragma once

#include <filesystem>
#include <vector>

#include "nanomap/decision_t.hpp"

namespace nanomap {

/// The decisions of a log, or of the parts of one, in the order of the file, on whatever channel: a decision is told by
/// its type.
/// @throws LogError if the log cannot be read; std::runtime_error naming the log if it holds no decision, or one that
///         is damaged
[[nodiscard]] std::vector<decision_t> readDecisions(const std::vector<std::filesystem::path>& parts);

}  // namespace nanomap
