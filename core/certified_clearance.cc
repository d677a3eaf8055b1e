#include "core/certified_clearance.h"

#include <cmath>

#include "core/classify.h"
#include "core/vouched_ball.h"

namespace nanomap {
namespace {

/// Takes views in turn and keeps the largest radius. What limits the ball of one view is looked at first in the next:
/// neighbours in time see the same, so that most of them are dismissed at a glance.
class LargestBall {
 public:
  LargestBall(const ChainSnapshot& snapshot, const UncertainPoint& x_B, const QueryOptions& options, double limit_m)
      : snapshot_(snapshot), x_B_(x_B), options_(options), limit_m_(limit_m) {}

  void tryView(std::uint32_t view_index) {
    const SnapshotView& view = snapshot_.views[view_index];
    const double drift_m = options_.certify_sigmas * std::sqrt(largestVarianceBound(view.edge_covariance_C_m2));
    const auto toCamera = [&view](const Vec3& at_B) -> Vec3 { return view.R_C_B * at_B + view.t_C_B_m; };
    std::optional<Vec3> look_first_C;
    if (is_limited_) look_first_C = toCamera(unseen_B_);
    const VouchedBall ball = vouchedBall(*view.view, toCamera(x_B_.mean_m), view.up_C, options_,
                                         {largest_.radius_m + drift_m, limit_m_ + drift_m}, look_first_C);
    if (ball.radius_m > largest_.radius_m + drift_m && endsSearch(classify(view, x_B_, options_))) {
      largest_ = {ball.radius_m - drift_m, ball.radius_m, view_index};
    }
    if (!ball.nearest_unseen_C) return;
    is_limited_ = true;
    unseen_B_ = view.R_C_B.transpose() * (*ball.nearest_unseen_C - view.t_C_B_m);
  }

  [[nodiscard]] bool reachesLimit() const { return largest_.radius_m >= limit_m_; }
  [[nodiscard]] const CertifiedClearance& largest() const { return largest_; }

 private:
  const ChainSnapshot& snapshot_;
  const UncertainPoint& x_B_;
  const QueryOptions& options_;
  double limit_m_;
  CertifiedClearance largest_;
  bool is_limited_ = false;
  Vec3 unseen_B_ = Vec3::Zero();  ///< what limited the last ball that was limited
};

}  // namespace

CertifiedClearance certifiedClearance(const ChainSnapshot& snapshot, const Vec3& p_B, const QueryOptions& options,
                                      double limit_m) {
  /// One view of so many goes first, so that a large radius is known before the ones between them are asked for more.
  constexpr std::uint32_t kStride = 8;
  const UncertainPoint x_B{p_B, Mat3::Zero()};
  LargestBall ball(snapshot, x_B, options, limit_m);
  for (const bool between : {false, true}) {
    ViewFilter::Walk candidates(snapshot.filter, snapshot.views.size(), x_B, options, 0);
    std::uint32_t count = 0;
    while (const auto view_index = candidates.next()) {
      if ((count++ % kStride != 0) != between) continue;
      ball.tryView(*view_index);
      if (ball.reachesLimit()) return ball.largest();
    }
  }
  return ball.largest();
}

}  // namespace nanomap
