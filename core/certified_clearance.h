#pragma once

#include <cstdint>
#include <optional>

#include "core/geometry.h"
#include "core/query_options.h"
#include "core/snapshot.h"

namespace nanomap {

/// How far around a point space is known to be empty. Nothing known is a radius of zero: it certifies nothing, and says
/// nothing about obstacles either.
struct CertifiedClearance {
  /// Radius around the point: the vouched one less `QueryOptions::certify_sigmas` standard deviations of the drift
  /// between that view and the body, along the worst axis. Not negative.
  double radius_m = 0.0;
  /// What the view vouches for (core/vouched_ball.h) around the point's mean in its camera frame, drift apart: to be
  /// held against the point's whole covariance in that view, which is the larger the older the view.
  double vouched_m = 0.0;
  std::optional<std::uint32_t> view_index;  ///< that view, in the snapshot, 0 the newest; empty if radius_m is 0
};

/// The largest certified radius that any view of the snapshot gives, or one of `limit_m` or more. Balls of several
/// views are not joined.
/// @param p_B      in the body frame at the snapshot's stamp
/// @param limit_m  larger radii are of no interest, and cost time
/// Allocates: no. Threads: any number of readers. No view, or a point that is not finite: nothing is certified.
[[nodiscard]] CertifiedClearance certifiedClearance(const ChainSnapshot& snapshot, const Vec3& p_B,
                                                    const QueryOptions& options, double limit_m);

}  // namespace nanomap
