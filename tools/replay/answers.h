#pragma once

#include <cstddef>
#include <span>

#include "core/query.h"
#include "core/snapshot.h"
#include "nanomap/answers_t.hpp"

namespace nanomap {

/// The message that records what was asked at one moment and what came back.
/// @param fan_count  how many of the points, from the first on, belong to the fan of motions
/// @pre points_B and replies are of equal size
[[nodiscard]] answers_t toMessage(const ChainSnapshot& snapshot, std::span<const UncertainPoint> points_B,
                                  std::span<const QueryReply> replies, std::size_t fan_count);

}  // namespace nanomap
