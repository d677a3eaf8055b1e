#include "tests/bench/references/slerp_correction.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace nanomap::bench {
namespace {

Eigen::Isometry3d isometry(const Quat& rotation, const Vec3& translation_m) {
  Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
  T.linear() = rotation.toRotationMatrix();
  T.translation() = translation_m;
  return T;
}

}  // namespace

SlerpCorrection::SlerpCorrection(std::vector<Time> stamps, const Pose& T_B_C)
    : stamps_(std::move(stamps)), T_B_C_(isometry(T_B_C.rotation, T_B_C.translation_m)) {
  assert(!stamps_.empty());
  T_older_newer_.resize(stamps_.size() - 1, Eigen::Isometry3d::Identity());
}

Eigen::Isometry3d SlerpCorrection::cameraAt(const Correction& correction, Time stamp) const {
  const auto after = std::upper_bound(correction.poses.begin() + 1, correction.poses.end() - 1, stamp,
                                      [](Time t, const CorrectedPose& pose) { return t < pose.stamp; });
  const CorrectedPose& from = *(after - 1);
  const CorrectedPose& to = *after;
  const double weight = toSeconds(stamp - from.stamp) / toSeconds(to.stamp - from.stamp);
  const Vec3 t_m = (1.0 - weight) * from.T_W_B.translation_m + weight * to.T_W_B.translation_m;
  return isometry(from.T_W_B.rotation.slerp(weight, to.T_W_B.rotation), t_m) * T_B_C_;
}

void SlerpCorrection::applyEdgeByEdge(const Correction& correction) {
  for (std::size_t i = 0; i + 1 < stamps_.size(); ++i) {
    T_older_newer_[i] = cameraAt(correction, stamps_[i + 1]).inverse() * cameraAt(correction, stamps_[i]);
  }
}

void SlerpCorrection::applyViewByView(const Correction& correction) {
  Eigen::Isometry3d T_W_newer = cameraAt(correction, stamps_.front());
  for (std::size_t i = 0; i + 1 < stamps_.size(); ++i) {
    const Eigen::Isometry3d T_W_older = cameraAt(correction, stamps_[i + 1]);
    T_older_newer_[i] = T_W_older.inverse() * T_W_newer;
    T_W_newer = T_W_older;
  }
}

}  // namespace nanomap::bench
