#include "firmware_app/safety/motion_in_force.h"

namespace nanomap {

void MotionInForce::update(const std::optional<Decision>& newest, std::uint64_t sequence, const Alignment& alignment) {
  if (alignment.verdict != AlignmentVerdict::kGood || !alignment.T_NED_W) return;
  if (newest && newest->consumed.epoch == alignment.epoch) {
    decision_ = newest;
    sequence_ = sequence;
  }
  if (decision_ && decision_->consumed.epoch == alignment.epoch) anchor_ = *alignment.T_NED_W;
}

}  // namespace nanomap
