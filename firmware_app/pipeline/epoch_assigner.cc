#include "firmware_app/pipeline/epoch_assigner.h"

#include <cmath>

namespace nanomap {
namespace {

/// Between poses stamped almost together, this much is the estimator's noise and no speed.
constexpr double kNoise_m = 0.05;

}  // namespace

std::uint32_t EpochAssigner::assign(Time stamp, const Pose& T_W_B) {
  if (max_speed_m_s_ == 0.0 || checkPose(T_W_B) != PoseVerdict::kAccepted) return epoch_;
  if (!newest_) {
    newest_ = Newest{stamp, T_W_B.translation_m};
    return epoch_;
  }
  const double reach_m = kNoise_m + max_speed_m_s_ * std::abs(toSeconds(stamp - newest_->stamp));
  const bool reachable = (T_W_B.translation_m - newest_->p_W_m).norm() <= reach_m;
  if (stamp <= newest_->stamp) return reachable || epoch_ == 0 ? epoch_ : epoch_ - 1;
  if (!reachable) ++epoch_;
  newest_ = Newest{stamp, T_W_B.translation_m};
  return epoch_;
}

}  // namespace nanomap
