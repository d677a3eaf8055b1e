#pragma once

#include <optional>

#include "core/pose_buffer.h"

namespace nanomap {

/// Epochs for a pose stream that has none of its own (bot_core.pose_t): a step faster than the vehicle can be is a jump
/// of the estimator's world and starts a new epoch, so that nothing is subtracted across it.
/// A single wrong pose far away costs two epochs: nothing tells it from two jumps.
/// Threads: one. Allocates: no.
class EpochAssigner {
 public:
  /// @param max_speed_m_s  fastest that the body can be; 0: there are no jumps
  explicit EpochAssigner(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  /// The epoch of the next pose as it comes in. One that arrives late belongs to the newest world if it can be reached
  /// from there, else to the one before; one that is no pose at all (NaN) changes nothing.
  [[nodiscard]] std::uint32_t assign(Time stamp, const Pose& T_W_B);

 private:
  struct Newest {
    Time stamp{};
    Vec3 p_W_m;
  };

  double max_speed_m_s_;
  std::uint32_t epoch_ = 0;
  std::optional<Newest> newest_;
};

}  // namespace nanomap
