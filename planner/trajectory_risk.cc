#include "planner/trajectory_risk.h"

#include <algorithm>
#include <cmath>

#include "planner/stretches.h"

namespace nanomap {
namespace {

/// What ends no faster stands at its end: a brake's end is computed.
constexpr double kStanding_m_s = 1e-6;

/// Of TrajectoryRisk::second_looks.
constexpr std::uint64_t bitOf(std::size_t sample) {
  constexpr std::size_t kLast = 63;
  return std::uint64_t{1} << std::min(sample, kLast);
}

/// Of touching what was measured, by the views that were asked. One error of the vehicle's place is behind all ways to
/// touch something: the likeliest of them counts.
double touchedProbability(const SampleEvidence& sample) {
  return std::max(
      {sample.collision_probability, sample.beside.collision_probability, sample.newer.collision_probability});
}

/// Of a veto that is due to `sample`: to the one that weighs most, or to the one that was too much.
VetoCause causeOf(const SampleEvidence& sample, double max_risk) {
  const double touched = touchedProbability(sample);
  if (sample.prior >= std::max(touched, sample.unseen_probability)) return {sample.status};
  if (touched <= max_risk && sample.unseen_probability > touched) return {Status::kPartial};
  return {};
}

/// The running risk of a trajectory, and what weighed most when it went over the constraint.
class RiskTally {
 public:
  explicit RiskTally(double max_risk) : max_risk_(max_risk) {}

  void add(const SampleEvidence& sample) {
    survival_ *= 1.0 - sample.risk;
    result_.least_distance_m = std::min(result_.least_distance_m, sample.distance_m());
    result_.largest_prior = std::max(result_.largest_prior, sample.prior);
    if (sample.needsSecondLook()) result_.second_looks |= bitOf(count_);
    ++count_;
    if (result_.veto) return;
    if (sample.risk > heaviest_.risk) heaviest_ = sample;
    if (1.0 - survival_ <= max_risk_) return;
    result_.veto = causeOf(heaviest_, max_risk_);
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
  std::size_t count_ = 0;
  SampleEvidence heaviest_;
  TrajectoryRisk result_;
};

double riskOf(const SampleEvidence& sample) {
  return 1.0 - (1.0 - sample.prior) * (1.0 - std::max(touchedProbability(sample), sample.unseen_probability));
}

}  // namespace

/// Where the vehicle may be at a moment.
struct SpaceAhead::Place {
  Vec3 mean_W_m;
  UncertainPoint x_B;
  double deviation_m;  ///< no less than the largest of x_B
};

/// What a view has measured there.
struct SpaceAhead::Near {
  double reach_m;  ///< that matters
  QueryReply reply;
  std::optional<double> nearest_m;
  double collision_probability;
};

SpaceAhead::SpaceAhead(const ChainSnapshot& snapshot, const RiskParameters& parameters, const Aside& aside)
    : snapshot_(snapshot),
      parameters_(parameters),
      aside_(aside),
      with_room_(parameters.query),
      R_B_W_(snapshot.T_W_B.rotation.conjugate().toRotationMatrix()) {
  with_room_.margin_m += parameters.collision.vehicle_radius_m;
}

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

SpaceAhead::Place SpaceAhead::placeAt(const Motion& motion_W, double elapsed_s) const {
  const double speed_m_s = motion_W.velocity_m_s.norm();
  const double horizontal_m = parameters_.horizontal.at(speed_m_s, elapsed_s);
  const double vertical_m = parameters_.vertical.at(speed_m_s, elapsed_s);
  const Vec3 mean_W_m = motion_W.position_m + aside_.at(elapsed_s);
  const Vec3 return_B_m = R_B_W_ * aside_.deviation(elapsed_s);
  return {mean_W_m,
          {R_B_W_ * (mean_W_m - snapshot_.T_W_B.translation_m),
           covariance_B(horizontal_m, vertical_m) + return_B_m * return_B_m.transpose()},
          std::hypot(std::max(horizontal_m, vertical_m), return_B_m.norm())};
}

/// @pre a view answers
SpaceAhead::Near SpaceAhead::nearTo(const Place& place, const Location& location) const {
  const double edge_m2 = largestVarianceBound(snapshot_.views[*location.view_index].edge_covariance_C_m2);
  const double reach_m = reachThatMatters_m(place.deviation_m * place.deviation_m + edge_m2, parameters_.collision);
  Near near{
      reach_m, nearestAt(snapshot_, location, place.x_B, parameters_.query, static_cast<float>(reach_m)), {}, 0.0};
  if (!near.reply.found().empty()) near.nearest_m = static_cast<double>(near.reply.found().front().distance_m);
  near.collision_probability = collisionProbability(near.reply.x_C, near.reply.found(), parameters_.collision);
  return near;
}

SecondLook SpaceAhead::lookInto(const Place& place, const std::optional<std::uint32_t>& view_index) const {
  SecondLook look;
  look.asked = true;
  if (!view_index) return look;
  const Near near = nearTo(place, {Status::kPartial, view_index});  // whatever the status: what is near counts
  look.view_index = view_index;
  look.nearest_m = near.nearest_m;
  look.collision_probability = near.collision_probability;
  return look;
}

bool SpaceAhead::hasRoom(const Near& near) const {
  const View& view = *snapshot_.views[*near.reply.view_index].view;
  const Vec3 half_size_C_m = near.reply.x_C.covariance_m2.diagonal().cwiseMax(0.0).cwiseSqrt();
  return contains(view.camera().frustum(), near.reply.x_C.mean_m, half_size_C_m.array() + with_room_.margin_m);
}

/// All samples of a trajectory but the start, in turn, until `visitor(motion_W, elapsed_s)` says false.
template <class Visitor>
void SpaceAhead::visit(const Trajectory& trajectory, int samples, Visitor&& visitor) const {
  const double longest_m = parameters_.collision.vehicle_radius_m;
  const Stretches stretches(trajectory, samples);
  if (!stretches.visit(longest_m, visitor)) return;

  const double end_s = stretches.end_s(stretches.count());
  const Motion end_W = stretches.at(end_s);
  const bool stands = end_W.velocity_m_s.norm() <= kStanding_m_s;
  if (!stands || aside_.isBackAt(end_s)) return;
  const int parts = std::max(1, static_cast<int>(std::ceil(aside_.at(end_s).norm() / longest_m)));
  for (int part = 1; part <= parts; ++part) {
    const double share = static_cast<double>(part) / parts;
    if (!visitor(end_W, part == parts ? aside_.recovery_s : std::lerp(end_s, aside_.recovery_s, share))) return;
  }
}

SampleEvidence SpaceAhead::assess(const Motion& motion_W, double elapsed_s, bool stop_early) const {
  const Place place = placeAt(motion_W, elapsed_s);
  const Location location = locate(snapshot_, place.x_B, parameters_.query);

  SampleEvidence sample;
  sample.elapsed_s = elapsed_s;
  sample.position_W_m = place.mean_W_m;
  sample.status = location.status;
  // Whole, the optional is stored in halves and read back at once, which waits for both.
  if (location.view_index) sample.view_index.emplace(*location.view_index);
  const double bubble_m = parameters_.collision.vehicle_radius_m + parameters_.bubble_margin_m;
  sample.in_bubble = place.x_B.mean_m.norm() <= bubble_m;
  sample.prior = sample.in_bubble ? 0.0 : parameters_.prior[static_cast<std::size_t>(location.status)];
  const bool certain = sample.prior >= 1.0;
  if (location.view_index && !(certain && stop_early)) {
    const Near near = nearTo(place, location);
    sample.nearest_m = near.nearest_m;
    sample.collision_probability = near.collision_probability;
    if (parameters_.look_beside && endsSearch(location.status)) {
      sample.cramped = !hasRoom(near);
      sample.overtaken = *location.view_index > 0;
    }
    // Both bound the same error: the larger one holds for what was measured and for what was not.
    const bool demanded = parameters_.demand_certificate && place.x_B.mean_m.norm() > parameters_.certificate_beyond_m;
    if (demanded && !certain && !(stop_early && sample.collision_probability > parameters_.max_risk)) {
      sample.unseen_probability = unseenProbability(place.x_B, near.reach_m);
    }
  }
  sample.risk = riskOf(sample);
  return sample;
}

void SpaceAhead::lookBeside(const Motion& motion_W, SampleEvidence& sample) const {
  if (!sample.needsSecondLook()) return;
  const Place place = placeAt(motion_W, sample.elapsed_s);
  if (sample.overtaken) {
    sample.newer = lookInto(place, newestHolding(snapshot_, place.x_B.mean_m, *sample.view_index));
  }
  if (sample.cramped) {
    const Location location = locate(snapshot_, place.x_B, with_room_);
    const bool has_room = endsSearch(location.status);
    sample.beside = lookInto(place, has_room ? location.view_index : std::nullopt);
    const bool far = !sample.in_bubble && place.x_B.mean_m.norm() > parameters_.beside_beyond_m;
    if (!has_room && far) sample.unseen_probability = 1.0;
  }
  sample.cramped = false;
  sample.overtaken = false;
  sample.risk = riskOf(sample);
}

std::optional<TrajectoryRisk> SpaceAhead::glance(const Trajectory& trajectory, int samples) const {
  // The end first: it is farthest into what may be in the way.
  const Stretches stretches(trajectory, samples);
  for (int i = stretches.count(); i > 0; --i) {
    const double elapsed_s = stretches.end_s(i);
    const SampleEvidence sample = assess(stretches.at(elapsed_s), elapsed_s, true);
    RiskTally tally(parameters_.max_risk);
    tally.add(sample);
    const TrajectoryRisk alone = tally.result(sample, sample);
    if (alone.veto) return alone;
  }
  return std::nullopt;
}

TrajectoryRisk SpaceAhead::assess(const Trajectory& trajectory, int samples, bool stop_early,
                                  std::vector<SampleEvidence>* evidence, const SampleEvidence* start) const {
  RiskTally tally(parameters_.max_risk);
  const auto goOn = [&](const SampleEvidence& sample) {
    tally.add(sample);
    if (evidence != nullptr) evidence->push_back(sample);
    return !(stop_early && tally.isVetoed());
  };
  const SampleEvidence first = start != nullptr ? *start : assess(trajectory.atStart(), 0.0, stop_early);
  SampleEvidence last = first;
  if (goOn(first)) {
    visit(trajectory, samples, [&](const Motion& motion_W, double elapsed_s) {
      last = assess(motion_W, elapsed_s, stop_early);
      return goOn(last);
    });
  }
  return tally.result(first, last);
}

void SpaceAhead::lookBeside(const Trajectory& trajectory, int samples, bool stop_early, TrajectoryRisk& judged,
                            std::vector<SampleEvidence>* evidence) const {
  if (judged.second_looks == 0) return;
  std::size_t count = 0;
  SampleEvidence sample;
  const auto goOn = [&](const Motion& motion_W, double elapsed_s) {
    const std::size_t number = count++;
    if ((judged.second_looks & bitOf(number)) == 0) return true;
    sample = assess(motion_W, elapsed_s);
    const double survival = 1.0 - sample.risk;
    lookBeside(motion_W, sample);
    judged.least_distance_m = std::min(judged.least_distance_m, sample.distance_m());
    if (survival > 0.0) judged.risk = 1.0 - (1.0 - judged.risk) * ((1.0 - sample.risk) / survival);
    if (!judged.veto && judged.risk > parameters_.max_risk) judged.veto = causeOf(sample, parameters_.max_risk);
    if (evidence != nullptr) (*evidence)[number] = sample;
    return !(stop_early && judged.veto);
  };
  const bool goes_on = goOn(trajectory.atStart(), 0.0);
  if (judged.first.needsSecondLook()) judged.first = sample;
  if (goes_on) visit(trajectory, samples, goOn);
  if (judged.last.needsSecondLook() && sample.elapsed_s == judged.last.elapsed_s) judged.last = sample;
  judged.second_looks = 0;
}

}  // namespace nanomap
