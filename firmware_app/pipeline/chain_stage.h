#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/chain.h"
#include "core/goal.h"
#include "core/vehicle_state.h"
#include "firmware_app/pipeline/message_intake.h"
#include "firmware_app/pipeline/stuck_camera.h"

namespace nanomap {

/// All that the chain has taken in, by what became of it.
struct ChainStageCounters {
  ChainCounters chain;
  std::uint64_t stuck_views = 0;  ///< of a camera that shows the same picture while the vehicle moves: left out
};

/// Stage T3: the chain, and what is known beside it that a plan is made from.
/// A function of what it is given, in that order. Allocates as the chain does. Threads: one.
class ChainStage {
 public:
  /// @throws std::invalid_argument naming the parameter that is wrong
  explicit ChainStage(const ChainParameters& parameters, const StuckDepthParameters& stuck_depth = {})
      : chain_(parameters), camera_(stuck_depth) {}

  /// Each takes in one thing, and says how many views have entered the chain by it.
  std::size_t take(const PoseInput& input);
  std::size_t take(const Correction& correction);
  std::size_t take(const Goal& goal);
  std::size_t take(ViewPtr view);

  [[nodiscard]] const Chain& chain() const { return chain_; }
  [[nodiscard]] ChainStageCounters counters() const { return {chain_.counters(), stuck_views_}; }

  /// The camera shows the same picture again and again, while the vehicle moves.
  [[nodiscard]] bool isCameraStuck() const { return camera_.isStuck(); }

  /// How the vehicle moves at the newest pose by stamp that the chain has accepted; empty before the first.
  [[nodiscard]] const std::optional<VehicleState>& state() const { return state_; }

  /// Exposure of the newest view of the chain; empty before the first.
  [[nodiscard]] std::optional<Time> newestView() const { return chain_.newestViewStamp(); }

  /// The goal received last, whatever its stamp and number: who restarts begins to count anew.
  [[nodiscard]] const std::optional<Goal>& goal() const { return goal_; }

 private:
  Chain chain_;
  StuckCamera camera_;
  std::uint64_t stuck_views_ = 0;
  std::optional<VehicleState> state_;
  std::optional<Goal> goal_;
};

}  // namespace nanomap
