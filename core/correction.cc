#include "core/correction.h"

#include <algorithm>

namespace nanomap {

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
    switch (checkPose(correction.poses[i].T_W_B)) {
      case PoseVerdict::kNotFinite:
        return CorrectionVerdict::kNotFinite;
      case PoseVerdict::kNotUnit:
        return CorrectionVerdict::kNotUnit;
      default:
        break;
    }
    if (i > 0 && correction.poses[i].stamp <= correction.poses[i - 1].stamp) return CorrectionVerdict::kNotOrdered;
  }
  return CorrectionVerdict::kAccepted;
}

void CorrectionField::assign(const Correction& correction, const PoseBuffer& originals) {
  epoch_ = correction.epoch;
  anchors_.clear();
  anchors_.reserve(correction.poses.size());
  originals_.clear();
  originals_.reserve(correction.poses.size());
  // In passes: what one pose writes is not read again at once, and poses do not wait for one another.
  PoseBuffer::Walk walk(originals);
  for (const CorrectedPose& corrected : correction.poses) {
    const PoseBuffer::Bracket original = walk.to(corrected.stamp);
    if (original.status != PoseBuffer::LookupStatus::kFound) continue;
    originals_.push_back(original.T_W_B());
    anchors_.push_back({corrected.stamp, original.to->epoch, corrected.T_W_B});
  }
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    Quat& R_Wnew_Wold = anchors_[i].T_Wnew_Wold.rotation;
    R_Wnew_Wold = R_Wnew_Wold.normalized() * originals_[i].rotation.conjugate();
  }
  for (std::size_t i = 0; i < anchors_.size(); ++i) {
    Pose& T_Wnew_Wold = anchors_[i].T_Wnew_Wold;
    T_Wnew_Wold.translation_m -= T_Wnew_Wold.rotation * originals_[i].translation_m;
  }
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
  if (anchors_.empty() || stamp < anchors_.front().stamp) return {};
  if (after == anchors_.size()) {
    const Anchor& last = anchors_.back();
    if (last.epoch == epoch) return {Coverage::kCarried, last.T_Wnew_Wold};
    // The stream itself has moved to the corrected world since: nothing is left to correct.
    if (epoch == epoch_) return {Coverage::kCarried, Pose{}};
    return {};
  }
  const Anchor& to = anchors_[after];
  if (to.stamp == stamp && to.epoch == epoch) return {Coverage::kInside, to.T_Wnew_Wold};
  if (after == 0) return {};
  const Anchor& from = anchors_[after - 1];
  if (from.epoch == epoch && to.epoch == epoch) {
    const double weight = shareOf(stamp, from.stamp, to.stamp);
    return {Coverage::kInside, interpolate(from.T_Wnew_Wold, to.T_Wnew_Wold, weight)};
  }
  // The stream's world jumped between the two anchors: each side takes the delta of its own world.
  if (from.epoch == epoch) return {Coverage::kInside, from.T_Wnew_Wold};
  if (to.epoch == epoch) return {Coverage::kInside, to.T_Wnew_Wold};
  return {};
}

}  // namespace nanomap
