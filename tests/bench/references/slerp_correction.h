#pragma once

#include <Eigen/Geometry>
#include <vector>

#include "core/correction.h"

namespace nanomap::bench {

/// What a chain does with a correction when it does the obvious: each view's pose is looked up in the window by binary
/// search and interpolated with Eigen's slerp, each edge is one pose's inverse times the next.
/// It takes corrected poses for what they are: no original poses, no deltas, no worlds that jump, nothing carried on.
/// Double precision. Allocates at construction only.
class SlerpCorrection {
 public:
  /// @param stamps  of the views, newest first
  SlerpCorrection(std::vector<Time> stamps, const Pose& T_B_C);

  /// Both ends of every edge interpolated for that edge. @pre the window holds two poses or more, around every stamp
  void applyEdgeByEdge(const Correction& correction);

  /// The same edges, each view's pose interpolated once for the two edges that it is an end of.
  void applyViewByView(const Correction& correction);

  /// T_{C_i+1}_{C_i}, newest first.
  [[nodiscard]] const std::vector<Eigen::Isometry3d>& edges() const { return T_older_newer_; }

 private:
  [[nodiscard]] Eigen::Isometry3d cameraAt(const Correction& correction, Time stamp) const;

  std::vector<Time> stamps_;
  Eigen::Isometry3d T_B_C_;
  std::vector<Eigen::Isometry3d> T_older_newer_;
};

}  // namespace nanomap::bench
