#include "planner/trajectory_risk.h"

#include <algorithm>
#include <cmath>

namespace nanomap {
namespace {

/// The running risk of a trajectory, and what weighed most when it went over the constraint.
class RiskTally {
 public:
  explicit RiskTally(double max_risk) : max_risk_(max_risk) {}

  void add(const SampleEvidence& sample) {
    survival_ *= 1.0 - sample.risk;
    result_.least_distance_m = std::min(result_.least_distance_m, sample.distance_m());
    result_.largest_prior = std::max(result_.largest_prior, sample.prior);
    if (result_.veto) return;
    if (sample.risk > heaviest_.risk) heaviest_ = sample;
    if (1.0 - survival_ <= max_risk_) return;
    result_.veto.emplace();
    if (heaviest_.prior >= std::max(heaviest_.collision_probability, heaviest_.unseen_probability)) {
      result_.veto->status = heaviest_.status;
    } else if (heaviest_.collision_probability <= max_risk_ &&
               heaviest_.unseen_probability > heaviest_.collision_probability) {
      result_.veto->status = Status::kPartial;
    }
  }

  [[nodiscard]] bool isVetoed() const { return result_.veto.has_value(); }

  [[nodiscard]] TrajectoryRisk result(const SampleEvidence& first, const SampleEvidence& last) const {
    TrajectoryRisk result = result_;
    result.risk = 1.0 - survival_;
    result.first = first;
    result.last = last;
    return result;
  }

 private:
  double max_risk_;
  double survival_ = 1.0;
  SampleEvidence heaviest_;
  TrajectoryRisk result_;
};

}  // namespace

SpaceAhead::SpaceAhead(const ChainSnapshot& snapshot, const RiskParameters& parameters)
    : snapshot_(snapshot), parameters_(parameters), R_B_W_(snapshot.T_W_B.rotation.conjugate().toRotationMatrix()) {}

/// Horizontally the same in every direction, so that a rotation needs W's vertical in B only.
Mat3 SpaceAhead::covariance_B(double horizontal_std_m, double vertical_std_m) const {
  const double horizontal_m2 = horizontal_std_m * horizontal_std_m;
  const double vertical_m2 = vertical_std_m * vertical_std_m;
  const Vec3 up_B = R_B_W_.col(2);
  return horizontal_m2 * Mat3::Identity() + (vertical_m2 - horizontal_m2) * up_B * up_B.transpose();
}

/// The chance of an error as large as what is left of the certified ball beside the vehicle, in the view that vouches
/// for it and with the point's whole covariance there.
double SpaceAhead::unseenProbability(const UncertainPoint& x_B, double reach_m) const {
  const CertifiedClearance certified = certifiedClearance(snapshot_, x_B.mean_m, parameters_.query, reach_m);
  if (!certified.view_index) return 1.0;
  const UncertainPoint x_C = snapshot_.views[*certified.view_index].toCamera(x_B);
  return errorTailBound(x_C.covariance_m2, certified.vouched_m - parameters_.collision.vehicle_radius_m);
}

SampleEvidence SpaceAhead::assess(const Motion& motion_W, double elapsed_s, bool stop_early) const {
  const double speed_m_s = motion_W.velocity_m_s.norm();
  const double horizontal_m = parameters_.horizontal.at(speed_m_s, elapsed_s);
  const double vertical_m = parameters_.vertical.at(speed_m_s, elapsed_s);
  const UncertainPoint x_B{R_B_W_ * (motion_W.position_m - snapshot_.T_W_B.translation_m),
                           covariance_B(horizontal_m, vertical_m)};
  const Location location = locate(snapshot_, x_B, parameters_.query);

  SampleEvidence sample;
  sample.elapsed_s = elapsed_s;
  sample.position_W_m = motion_W.position_m;
  sample.status = location.status;
  sample.view_index = location.view_index;
  const double bubble_m = parameters_.collision.vehicle_radius_m + parameters_.bubble_margin_m;
  sample.in_bubble = x_B.mean_m.norm() <= bubble_m;
  sample.prior = sample.in_bubble ? 0.0 : parameters_.prior[static_cast<std::size_t>(location.status)];
  const bool certain = sample.prior >= 1.0;
  if (location.view_index && !(certain && stop_early)) {
    const double deviation_m = std::max(horizontal_m, vertical_m);
    const double edge_m2 = largestVarianceBound(snapshot_.views[*location.view_index].edge_covariance_C_m2);
    const double reach_m = reachThatMatters_m(deviation_m * deviation_m + edge_m2, parameters_.collision);
    const QueryReply reply = nearestAt(snapshot_, location, x_B, parameters_.query, static_cast<float>(reach_m));
    if (!reply.found().empty()) sample.nearest_m = static_cast<double>(reply.found().front().distance_m);
    sample.collision_probability = collisionProbability(reply.x_C, reply.found(), parameters_.collision);
    // Both bound the same error: the larger one holds for what was measured and for what was not.
    const bool demanded = parameters_.demand_certificate && x_B.mean_m.norm() > parameters_.certificate_beyond_m;
    if (demanded && !certain && !(stop_early && sample.collision_probability > parameters_.max_risk)) {
      sample.unseen_probability = unseenProbability(x_B, reach_m);
    }
  }
  const double reached = std::max(sample.collision_probability, sample.unseen_probability);
  sample.risk = 1.0 - (1.0 - sample.prior) * (1.0 - reached);
  return sample;
}

std::optional<TrajectoryRisk> SpaceAhead::glance(const Trajectory& trajectory, int samples) const {
  constexpr int kGlances = 5;
  const int stride = std::max(samples / kGlances, 1);
  // The end first: it is farthest into what may be in the way.
  for (int i = samples; i > 0; i -= stride) {
    const double elapsed_s = trajectory.duration_s() * i / samples;
    const SampleEvidence sample = assess(trajectory.sample(elapsed_s), elapsed_s, true);
    RiskTally tally(parameters_.max_risk);
    tally.add(sample);
    const TrajectoryRisk alone = tally.result(sample, sample);
    if (alone.veto) return alone;
  }
  return std::nullopt;
}

TrajectoryRisk SpaceAhead::assess(const Trajectory& trajectory, int samples, bool stop_early,
                                  std::vector<SampleEvidence>* evidence, const SampleEvidence* start) const {
  const double duration_s = trajectory.duration_s();
  const double radius_m = parameters_.collision.vehicle_radius_m;
  RiskTally tally(parameters_.max_risk);
  const auto add = [&](const SampleEvidence& sample) {
    tally.add(sample);
    if (evidence != nullptr) evidence->push_back(sample);
    return sample;
  };
  const auto assessAt = [&](const Motion& motion_W, double elapsed_s) {
    return add(assess(motion_W, elapsed_s, stop_early));
  };
  const auto decided = [&] { return stop_early && tally.isVetoed(); };

  const SampleEvidence first = start != nullptr ? add(*start) : assessAt(trajectory.atStart(), 0.0);
  SampleEvidence last = first;
  Vec3 previous_W_m = first.position_W_m;
  for (int i = 1; i <= samples && !decided(); ++i) {
    const double begin_s = duration_s * (i - 1) / samples;
    const double end_s = duration_s * i / samples;
    const Motion next_W = trajectory.sample(end_s);
    const int parts = std::max(static_cast<int>(std::ceil((next_W.position_m - previous_W_m).norm() / radius_m)), 1);
    for (int part = 1; part < parts && !decided(); ++part) {
      const double elapsed_s = std::lerp(begin_s, end_s, static_cast<double>(part) / parts);
      last = assessAt(trajectory.sample(elapsed_s), elapsed_s);
    }
    if (!decided()) last = assessAt(next_W, end_s);
    previous_W_m = next_W.position_m;
  }
  return tally.result(first, last);
}

}  // namespace nanomap
