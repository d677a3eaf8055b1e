#pragma once

#include <optional>

#include "core/pose_buffer.h"

namespace nanomap {

/// Epochs for a pose stream as NanoMap needs them: raised whenever the estimator's world jumps, so that nothing is
/// subtracted across it. What the sender says counts (nanomap.body_pose_t; bot_core.pose_t is always in epoch 0), and a
/// step faster than the vehicle can be is a jump that the sender did not tell, and raises every epoch from then on. So
/// does a sender that counts less than before and has not come late: it has started anew, in a world of its own.
/// A single wrong pose far away costs two epochs: nothing tells it from two jumps.
/// Threads: one. Allocates: no.
class EpochAssigner {
 public:
  /// @param max_speed_m_s  fastest that the body can be; 0: only the sender knows of jumps
  explicit EpochAssigner(double max_speed_m_s) : max_speed_m_s_(max_speed_m_s) {}

  /// The epoch of the next pose as it comes in. One that arrives late belongs to the newest world if it can be reached
  /// from there, else to the one before; later by more than a second it is what is compared with from then on. One that
  /// is no pose at all (NaN) changes nothing.
  [[nodiscard]] std::uint32_t assign(Time stamp, const Pose& T_W_B, std::uint32_t sent_epoch = 0);

  /// The epoch of what is no pose (a correction, a goal) and comes in now.
  [[nodiscard]] std::uint32_t epochOf(std::uint32_t sent_epoch) const { return sent_epoch + jumps_; }

 private:
  struct Newest {
    Time stamp{};
    std::uint32_t sent_epoch = 0;
    Vec3 p_W_m;
  };

  double max_speed_m_s_;
  std::uint32_t jumps_ = 0;  ///< that no sender told
  std::optional<Newest> newest_;
};

}  // namespace nanomap
