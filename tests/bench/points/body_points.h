#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <vector>

#include "core/query.h"
#include "core/snapshot.h"
#include "tests/bench/frames/recorded_flight.h"

namespace nanomap::bench {

/// Uncertain points in B, by which views of a snapshot answer them. Each set has a seed of its own. A set that the
/// snapshot has too few points for (a camera that stands still has no views that see more than the newest) is empty.
class BodyPoints {
 public:
  using Locate = std::function<std::optional<std::uint32_t>(const UncertainPoint&)>;

  /// Borrows all arguments.
  /// @param frames  those of the snapshot's views, oldest first
  /// @param locate  the reference's opinion
  BodyPoints(const ChainSnapshot& snapshot, std::span<const DepthImage> frames, Locate locate);

  /// Answered by a view from number `first` on and before number `end`, 0 the newest. Points of no depth are left out:
  /// some of them are sky to one and unknown to the other.
  [[nodiscard]] std::vector<UncertainPoint> answeredBy(std::size_t first, std::size_t end, std::size_t count) const;

  /// In no view's frustum, near the vehicle.
  [[nodiscard]] std::vector<UncertainPoint> inNoView(std::size_t count) const;

  /// In every view's frustum, and behind what it shows.
  [[nodiscard]] std::vector<UncertainPoint> occludedInEveryView(std::size_t count) const;

 private:
  template <class Draw>
  [[nodiscard]] std::vector<UncertainPoint> draw(unsigned seed, std::size_t count, Draw&& draw) const;
  template <class Predicate>
  [[nodiscard]] bool everyView(const UncertainPoint& x_B, Predicate&& holds) const;

  const ChainSnapshot& snapshot_;
  std::span<const DepthImage> frames_;
  Locate locate_;
};

}  // namespace nanomap::bench
