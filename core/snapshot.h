#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/geometry.h"
#include "core/snapshot_view.h"
#include "core/time.h"
#include "core/view_filter.h"

namespace nanomap {

/// The chain at the moment of its newest pose. Read it from any number of threads while the chain moves on.
struct ChainSnapshot {
  Time stamp{};  ///< of the body frame B
  Pose T_W_B;    ///< as the estimator gave it
  std::uint32_t epoch = 0;
  std::uint64_t pose_sequence = 0;
  std::optional<std::uint64_t> correction_sequence;  ///< of the last correction accepted
  std::vector<SnapshotView> views;                   ///< newest first
  ViewFilter filter;                                 ///< of `views`; an empty one rules nothing out
};

}  // namespace nanomap
