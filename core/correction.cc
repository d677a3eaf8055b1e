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

CorrectionField::CorrectionField(const Correction& correction, const PoseBuffer& originals) : epoch_(correction.epoch) {
  anchors_.reserve(correction.poses.size());
  for (const CorrectedPose& corrected : correction.poses) {
    const PoseBuffer::Lookup original = originals.interpolate(corrected.stamp);
    if (original.status != PoseBuffer::LookupStatus::kFound) continue;
    const Pose T_Wnew_B{corrected.T_W_B.rotation.normalized(), corrected.T_W_B.translation_m};
    anchors_.push_back({corrected.stamp, original.epoch, T_Wnew_B * original.T_W_B.inverse()});
  }
}

CorrectionField::Corrected CorrectionField::apply(Time stamp, const Pose& T_W_B_original, std::uint32_t epoch) const {
  if (anchors_.empty() || stamp < anchors_.front().stamp) return {};
  const auto corrected = [&](Coverage coverage, const Pose& T_Wnew_Wold) {
    return Corrected{coverage, T_Wnew_Wold * T_W_B_original};
  };
  const auto after = std::lower_bound(anchors_.begin(), anchors_.end(), stamp,
                                      [](const Anchor& anchor, Time t) { return anchor.stamp < t; });
  if (after == anchors_.end()) {
    const Anchor& last = anchors_.back();
    if (last.epoch == epoch) return corrected(Coverage::kCarried, last.T_Wnew_Wold);
    // The stream itself has moved to the corrected world since: nothing is left to correct.
    if (epoch == epoch_) return corrected(Coverage::kCarried, Pose{});
    return {};
  }
  if (after->stamp == stamp && after->epoch == epoch) return corrected(Coverage::kInside, after->T_Wnew_Wold);
  if (after == anchors_.begin()) return {};
  const Anchor& from = *(after - 1);
  const Anchor& to = *after;
  if (from.epoch == epoch && to.epoch == epoch) {
    const double weight =
        static_cast<double>((stamp - from.stamp).count()) / static_cast<double>((to.stamp - from.stamp).count());
    return corrected(Coverage::kInside, interpolate(from.T_Wnew_Wold, to.T_Wnew_Wold, weight));
  }
  // The stream's world jumped between the two anchors: each side takes the delta of its own world.
  if (from.epoch == epoch) return corrected(Coverage::kInside, from.T_Wnew_Wold);
  if (to.epoch == epoch) return corrected(Coverage::kInside, to.T_Wnew_Wold);
  return {};
}

}  // namespace nanomap
