#include "core/correction.h"

#include <algorithm>

namespace nanomap {
namespace {

const Pose kIdentity;  ///< the delta of what needs no correction

}  // namespace

std::string_view toString(CorrectionVerdict verdict) {
  switch (verdict) {
    case CorrectionVerdict::kAccepted:
      return "accepted";
    case CorrectionVerdict::kEmpty:
      return "empty";
    case CorrectionVerdict::kNotOrdered:
      return "stamps do not increase";
    case CorrectionVerdict::kNotFinite:
      return "not finite";
    case CorrectionVerdict::kNotUnit:
      return "not a unit quaternion";
    case CorrectionVerdict::kStaleEpoch:
      return "stale epoch";
    case CorrectionVerdict::kOutOfOrder:
      return "out of order";
    case CorrectionVerdict::kNoOverlap:
      return "no original pose at its stamps";
  }
  return "?";
}

CorrectionVerdict checkCorrection(const Correction& correction) {
  if (correction.poses.empty()) return CorrectionVerdict::kEmpty;
  for (std::size_t i = 0; i < correction.poses.size(); ++i) {
    const Pose& T_W_B = correction.poses[i].T_W_B;
    if (!isUsable(T_W_B)) {
      return checkPose(T_W_B) == PoseVerdict::kNotUnit ? CorrectionVerdict::kNotUnit : CorrectionVerdict::kNotFinite;
    }
    if (i > 0 && correction.poses[i].stamp <= correction.poses[i - 1].stamp) return CorrectionVerdict::kNotOrdered;
  }
  return CorrectionVerdict::kAccepted;
}

void CorrectionField::assign(const Correction& correction, const PoseBuffer& originals) {
  epoch_ = correction.epoch;
  anchors_.clear();
  anchors_.reserve(correction.poses.size());
  jobs_.clear();
  jobs_.reserve(correction.poses.size());
  PoseBuffer::Walk walk(originals);
  for (const CorrectedPose& corrected : correction.poses) {
    const PoseBuffer::Bracket original = walk.to(corrected.stamp);
    if (original.status != PoseBuffer::LookupStatus::kFound) continue;
    Anchor& anchor = anchors_.emplace_back();
    anchor.stamp = corrected.stamp;
    anchor.epoch = original.to->epoch;
    jobs_.push_back(
        {&original.from->T_W_B, original.weight, &original.to->T_W_B, &corrected.T_W_B, &anchor.T_Wnew_Wold});
  }
  makeDeltas(jobs_);
}

CorrectionField::Delta CorrectionField::deltaAt(Time stamp, std::uint32_t epoch) const {
  const auto after = std::lower_bound(anchors_.begin(), anchors_.end(), stamp,
                                      [](const Anchor& anchor, Time t) { return anchor.stamp < t; });
  return deltaBefore(static_cast<std::size_t>(after - anchors_.begin()), stamp, epoch);
}

CorrectionField::Delta CorrectionField::Walk::deltaAt(Time stamp, std::uint32_t epoch) {
  while (after_ < field_.anchors_.size() && field_.anchors_[after_].stamp < stamp) ++after_;
  return field_.deltaBefore(after_, stamp, epoch);
}

CorrectionField::Delta CorrectionField::deltaBefore(std::size_t after, Time stamp, std::uint32_t epoch) const {
  const auto one = [](Coverage coverage, const Pose& delta) { return Delta{coverage, &delta, &delta, 1.0}; };
  if (anchors_.empty() || stamp < anchors_.front().stamp) return {};
  if (after == anchors_.size()) {
    const Anchor& last = anchors_.back();
    if (last.epoch == epoch) return one(Coverage::kCarried, last.T_Wnew_Wold);
    // The stream itself has moved to the corrected world since: nothing is left to correct.
    if (epoch == epoch_) return one(Coverage::kCarried, kIdentity);
    return {};
  }
  const Anchor& to = anchors_[after];
  if (to.stamp == stamp && to.epoch == epoch) return one(Coverage::kInside, to.T_Wnew_Wold);
  if (after == 0) return {};
  const Anchor& from = anchors_[after - 1];
  if (from.epoch == epoch && to.epoch == epoch) {
    return {Coverage::kInside, &from.T_Wnew_Wold, &to.T_Wnew_Wold, shareOf(stamp, from.stamp, to.stamp)};
  }
  // The stream's world jumped between the two anchors: each side takes the delta of its own world.
  if (from.epoch == epoch) return one(Coverage::kInside, from.T_Wnew_Wold);
  if (to.epoch == epoch) return one(Coverage::kInside, to.T_Wnew_Wold);
  return {};
}

}  // namespace nanomap
