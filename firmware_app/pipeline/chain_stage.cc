#include "firmware_app/pipeline/chain_stage.h"

#include <utility>

#include "firmware_app/pipeline/vehicle_state.h"

namespace nanomap {

std::size_t ChainStage::take(const PoseInput& input) {
  const Chain::PoseOutcome outcome = chain_.addPose(input.pose);
  const bool newest = !state_ || input.pose.stamp > state_->stamp;
  if (newest && outcome.verdict == PoseVerdict::kAccepted) {
    state_ = vehicleStateAt(input.pose, input.motion, chain_.poses());
  }
  return outcome.views_inserted;
}

std::size_t ChainStage::take(const Correction& correction) {
  chain_.addCorrection(correction);
  return 0;
}

std::size_t ChainStage::take(const Goal& goal) {
  goal_ = goal;
  return 0;
}

std::size_t ChainStage::take(ViewPtr view) {
  if (camera_.see(view, state_)) {
    ++stuck_views_;
    return 0;
  }
  const Chain::ViewOutcome entered = chain_.addView(std::move(view));
  return entered.waiting || entered.drop ? 0 : 1;
}

}  // namespace nanomap
