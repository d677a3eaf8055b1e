#include "core/pose_buffer.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <utility>

namespace nanomap {
namespace {

bool usable(const DriftIncrement& increment) {
  if (increment.interval <= Duration::zero() || !increment.covariance_W_m2.allFinite()) return false;
  const Mat3& covariance = increment.covariance_W_m2;
  const double scale = covariance.cwiseAbs().maxCoeff();
  constexpr double kRounding = 1e-9;
  if ((covariance - covariance.transpose()).cwiseAbs().maxCoeff() > kRounding * scale) return false;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() >= -kRounding * scale;
}

}  // namespace

std::string_view toString(PoseVerdict verdict) {
  switch (verdict) {
    case PoseVerdict::kAccepted:
      return "accepted";
    case PoseVerdict::kDuplicate:
      return "duplicate";
    case PoseVerdict::kConflict:
      return "another pose with the same stamp";
    case PoseVerdict::kTooOld:
      return "too old";
    case PoseVerdict::kNotFinite:
      return "not finite";
    case PoseVerdict::kNotUnit:
      return "not a unit quaternion";
    case PoseVerdict::kStaleEpoch:
      return "stale epoch";
  }
  return "?";
}

PoseVerdict checkPose(const Pose& pose) {
  if (isUsable(pose)) return PoseVerdict::kAccepted;
  const bool finite = pose.translation_m.allFinite() && pose.rotation.coeffs().allFinite();
  return finite ? PoseVerdict::kNotUnit : PoseVerdict::kNotFinite;
}

PoseBuffer::PoseBuffer(std::size_t capacity, Duration max_gap) : poses_(capacity), max_gap_(max_gap) {}

PoseVerdict PoseBuffer::insert(BodyPose pose) {
  if (const PoseVerdict verdict = checkPose(pose.T_W_B); verdict != PoseVerdict::kAccepted) return verdict;
  pose.T_W_B.rotation.normalize();
  if (pose.increment && !usable(*pose.increment)) pose.increment.reset();

  const std::size_t at = lowerBound(pose.stamp);
  const bool held = at < poses_.size() && poses_[at].stamp == pose.stamp;
  if (held) return poses_[at].T_W_B == pose.T_W_B ? PoseVerdict::kDuplicate : PoseVerdict::kConflict;
  if (at == 0 && poses_.full()) return PoseVerdict::kTooOld;
  const bool after_newer_epoch = at > 0 && pose.epoch < poses_[at - 1].epoch;
  const bool before_older_epoch = at < poses_.size() && pose.epoch > poses_[at].epoch;
  if (after_newer_epoch || before_older_epoch) return PoseVerdict::kStaleEpoch;

  if (!poses_.full()) {
    poses_.insert(at, std::move(pose));
  } else {
    poses_.popFront();
    poses_.insert(at - 1, std::move(pose));
  }
  return PoseVerdict::kAccepted;
}

PoseBuffer::Lookup PoseBuffer::interpolate(Time stamp) const {
  const Bracket bracket = bracketBefore(lowerBound(stamp), stamp);
  if (bracket.status != LookupStatus::kFound) return {bracket.status, {}, 0};
  return {LookupStatus::kFound, bracket.T_W_B(), bracket.to->epoch};
}

PoseBuffer::Bracket PoseBuffer::Walk::to(Time stamp) {
  std::size_t after = after_ ? *after_ : poses_.lowerBound(stamp);
  while (after < poses_.size() && poses_.poses_[after].stamp < stamp) ++after;
  after_ = after;
  return poses_.bracketBefore(after, stamp);
}

PoseBuffer::Bracket PoseBuffer::bracketBefore(std::size_t after, Time stamp) const {
  if (after == poses_.size()) return {.status = LookupStatus::kAfterNewest};
  const BodyPose& to = poses_[after];
  if (to.stamp == stamp) return {LookupStatus::kFound, &to, &to, 1.0};
  if (after == 0) return {.status = LookupStatus::kBeforeOldest};
  const BodyPose& from = poses_[after - 1];
  if (from.epoch != to.epoch) return {.status = LookupStatus::kBetweenEpochs};
  if (to.stamp - from.stamp > max_gap_) return {.status = LookupStatus::kGap};
  return {LookupStatus::kFound, &from, &to, shareOf(stamp, from.stamp, to.stamp)};
}

std::optional<Mat3> PoseBuffer::accumulatedCovariance(Time from, Time to) const {
  Mat3 sum_W_m2 = Mat3::Zero();
  Time covered = from;
  for (std::size_t i = lowerBound(from); covered < to && i < poses_.size(); ++i) {
    if (poses_[i].stamp == from) continue;
    if (!poses_[i].increment) return std::nullopt;
    const Time end = std::min(poses_[i].stamp, to);
    const DriftIncrement& increment = *poses_[i].increment;
    sum_W_m2 += toSeconds(end - covered) / toSeconds(increment.interval) * increment.covariance_W_m2;
    covered = end;
  }
  if (covered < to) return std::nullopt;
  return sum_W_m2;
}

std::size_t PoseBuffer::lowerBound(Time stamp) const {
  // Poses come in order, or nearly so: the newest one decides most calls.
  if (poses_.empty() || poses_.back().stamp < stamp) return poses_.size();
  std::size_t low = 0;
  std::size_t high = poses_.size();
  while (low < high) {
    const std::size_t middle = low + (high - low) / 2;
    if (poses_[middle].stamp < stamp) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

}  // namespace nanomap
