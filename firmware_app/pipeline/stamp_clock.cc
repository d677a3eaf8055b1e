#include "firmware_app/pipeline/stamp_clock.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace nanomap {
namespace {

/// From a pose's stamp to its arrival, with a log: as little as an estimator needs.
constexpr Duration kPoseDelay = std::chrono::milliseconds(5);

void move(Time& stamp, Duration shift) {
  constexpr Duration kLatest(std::int64_t{1} << 62);
  stamp = Time(std::clamp(stamp.time_since_epoch() + shift, Duration::zero(), kLatest));
}

}  // namespace

StampClock::StampClock(ClockDomain domain, Duration max_lead, Duration realtime_ahead)
    : domain_(domain), max_lead_(max_lead) {
  if (domain == ClockDomain::kMonotonic) shift_ = Duration::zero();
  if (domain == ClockDomain::kRealtime) shift_ = -realtime_ahead;
}

std::optional<Duration> StampClock::noteRealtime(Duration realtime_ahead, Time now) {
  if (domain_ != ClockDomain::kRealtime) return std::nullopt;
  const Duration set_by = realtime_ahead + *shift_;
  const Time measured_before = std::exchange(measured_, now);
  if (std::chrono::abs(set_by) < kSmallestStep) return std::nullopt;
  step_ = {measured_before, now, *shift_};
  shift_ = -realtime_ahead;
  return set_by;
}

std::optional<Duration> StampClock::shift(InputKind kind, Time stamp, Time arrival) {
  if (step_ && isFromBefore(*step_, stamp, arrival)) return step_->shift_before;
  if (shift_) return shift_;
  if (kind == InputKind::kGoal) return arrival - stamp;  // holds from now on
  if (kind != InputKind::kPose) return std::nullopt;
  const Duration difference = arrival - stamp;
  if (!listening_since_) {
    listening_since_ = arrival;
    least_ = difference;
  }
  least_ = std::min(least_, difference);
  if (arrival - *listening_since_ >= kLogListening) shift_ = least_ - kPoseDelay;
  return shift_;
}

bool StampClock::isFromBefore(const Step& step, Time stamp, Time arrival) const {
  const Time if_after = stamp + *shift_;
  return stamp + step.shift_before <= step.latest && (if_after < step.earliest || if_after > arrival + max_lead_);
}

std::optional<Time> stampOf(const Input& input) {
  if (const auto* pose = std::get_if<PoseInput>(&input)) return pose->pose.stamp;
  if (const auto* depth = std::get_if<DepthInput>(&input)) return depth->image.stamp;
  if (const auto* goal = std::get_if<Goal>(&input)) return goal->stamp;
  if (const auto* correction = std::get_if<Correction>(&input)) {
    if (!correction->poses.empty()) return correction->poses.back().stamp;
  }
  return std::nullopt;
}

void shiftStamps(Input& input, Duration shift) {
  if (auto* pose = std::get_if<PoseInput>(&input)) move(pose->pose.stamp, shift);
  if (auto* depth = std::get_if<DepthInput>(&input)) move(depth->image.stamp, shift);
  if (auto* goal = std::get_if<Goal>(&input)) move(goal->stamp, shift);
  if (auto* correction = std::get_if<Correction>(&input)) {
    for (CorrectedPose& pose : correction->poses) move(pose.stamp, shift);
  }
}

}  // namespace nanomap
