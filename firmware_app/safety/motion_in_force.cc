#include "firmware_app/safety/motion_in_force.h"

namespace nanomap {

namespace {

bool isKnown(const Alignment& alignment, const std::optional<Decision>& decision) {
  return alignment.verdict == AlignmentVerdict::kGood && alignment.T_NED_W && decision &&
         decision->consumed.epoch == alignment.epoch;
}

}  // namespace

void MotionInForce::adopt(const std::optional<Decision>& newest, std::uint64_t sequence, const Alignment& alignment) {
  if (!isKnown(alignment, newest)) return;
  decision_ = newest;
  sequence_ = sequence;
  follow(alignment);
}

void MotionInForce::follow(const Alignment& alignment) {
  if (isKnown(alignment, decision_)) {
    anchor_ = *alignment.T_NED_W;
    contradicted_ = false;
  } else if (alignment.verdict == AlignmentVerdict::kInconsistent) {
    contradicted_ = true;
  }
}

bool MotionInForce::anchorHolds(const Alignment& alignment, std::uint32_t poses_epoch) const {
  if (!decision_ || contradicted_) return false;
  const std::uint32_t epoch = decision_->consumed.epoch;
  if (epoch != poses_epoch || epoch != alignment.epoch) return autopilot_world_ == AutopilotWorld::kItsOwn;
  const bool silent = alignment.verdict == AlignmentVerdict::kUnknown && alignment.T_NED_W;
  return silent || isKnown(alignment, decision_);
}

}  // namespace nanomap
