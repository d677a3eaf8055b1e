#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

#include "core/chain.h"
#include "core/snapshot.h"
#include "core/view_pool.h"
#include "tests/bench/frames/recorded_flight.h"
#include "tests/bench/references/sequential_chain.h"

namespace nanomap::bench {

using TreeBuilder =
    std::function<std::unique_ptr<const NearestPointIndex>(const DepthImage& image, const CameraModel& camera)>;

/// A full chain before and after the last frame of a flight is inserted. Borrows the flight.
struct ChainFixture {
  ChainFixture(const RecordedFlight& flight, std::size_t history);

  /// Inserts the last frame and its pose into `chain`, a copy of `before`, and takes the snapshot.
  void insertLast(Chain& chain, ChainSnapshot& out) const;

  /// The frames of `after`, oldest first.
  [[nodiscard]] std::span<const DepthImage> frames() const;

  enum class Trees { kOfEveryFrame, kOfNewestFrame };
  /// The reference that holds the same as `after`.
  [[nodiscard]] std::shared_ptr<SequentialChain> sequential(Trees trees, const TreeBuilder& build) const;

  const RecordedFlight& flight;
  std::shared_ptr<ViewPool> pool;
  Chain before;
  ChainSnapshot after;
  std::vector<Edge> edges;  ///< of `after`
};

}  // namespace nanomap::bench
