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
}

void MotionInForce::follow(const Alignment& alignment) {
  if (isKnown(alignment, decision_)) anchor_ = *alignment.T_NED_W;
}

}  // namespace nanomap
