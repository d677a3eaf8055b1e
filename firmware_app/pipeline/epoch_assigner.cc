#include "firmware_app/pipeline/epoch_assigner.h"

#include <cmath>

namespace nanomap {
namespace {

/// Between poses stamped almost together, this much is the estimator's noise and no speed.
constexpr double kNoise_m = 0.05;

/// A pose that is older than the newest by more has not come late: the newest was of another clock, or the clock has
/// been set back. To wait until it is passed would be to see no jump until then.
constexpr Duration kGreatestLateness = std::chrono::seconds(1);

}  // namespace

std::uint32_t EpochAssigner::assign(Time stamp, const Pose& T_W_B, std::uint32_t sent_epoch) {
  if (max_speed_m_s_ == 0.0 || checkPose(T_W_B) != PoseVerdict::kAccepted) return epochOf(sent_epoch);
  const Newest pose{stamp, sent_epoch, T_W_B.translation_m};
  if (newest_ && sent_epoch < newest_->sent_epoch) {
    if (stamp <= newest_->stamp) return epochOf(sent_epoch);
    jumps_ += newest_->sent_epoch - sent_epoch + 1;
    newest_ = pose;
    return epochOf(sent_epoch);
  }
  if (!newest_ || sent_epoch > newest_->sent_epoch || newest_->stamp - stamp > kGreatestLateness) {
    newest_ = pose;
    return epochOf(sent_epoch);
  }
  const double reach_m = kNoise_m + max_speed_m_s_ * std::abs(toSeconds(stamp - newest_->stamp));
  const bool reachable = (pose.p_W_m - newest_->p_W_m).norm() <= reach_m;
  if (stamp <= newest_->stamp) return epochOf(sent_epoch) - (reachable || jumps_ == 0 ? 0 : 1);
  if (!reachable) ++jumps_;
  newest_ = pose;
  return epochOf(sent_epoch);
}

}  // namespace nanomap
