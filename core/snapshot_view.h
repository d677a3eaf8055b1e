#pragma once

#include "core/geometry.h"
#include "core/view.h"

namespace nanomap {

/// One view of a snapshot, with all edges from the body to it composed:
/// x_C = N(T_C_B * mu_B, edge_covariance + R_C_B * Sigma_B * R_C_B^T), which equals the step-by-step sum of the
/// paper's IV.A.1 (with the rotation on both sides, as a covariance needs).
struct SnapshotView {
  ViewPtr view;
  Mat3 R_C_B = Mat3::Identity();
  Vec3 t_C_B_m = Vec3::Zero();
  Mat3 edge_covariance_C_m2 = Mat3::Zero();  ///< accumulated over the edges
  Vec3 up_C = Vec3::Zero();                  ///< W's z axis

  [[nodiscard]] UncertainPoint toCamera(const UncertainPoint& x_B) const {
    return {R_C_B * x_B.mean_m + t_C_B_m, edge_covariance_C_m2 + R_C_B * x_B.covariance_m2 * R_C_B.transpose()};
  }
};

}  // namespace nanomap
