#include "drivers/mavlink/alignment_fit.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "core/level_frame.h"

namespace nanomap {
namespace {

/// The upper one of two middle values. @pre not empty; reorders
double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of the pairs from `first` on. @pre there is one
template <class Value>
double medianOf(const RingBuffer<AlignmentPair>& pairs, Value&& value, std::size_t first = 0) {
  std::vector<double> values;
  values.reserve(pairs.size() - first);
  for (std::size_t i = first; i < pairs.size(); ++i) values.push_back(value(pairs[i]));
  return median(values);
}

/// Heading of W's x axis as the two attitudes have it.
double headingByAttitude(const RingBuffer<AlignmentPair>& pairs) {
  const auto of = [](const AlignmentPair& pair) { return pair.heading_NED_rad + pair.yaw_W_rad; };
  // Angles have no order: the median is taken of what they differ from one of them.
  const double reference_rad = of(pairs[pairs.size() / 2]);
  return reference_rad +
         medianOf(pairs, [&](const AlignmentPair& pair) { return wrapAngle(of(pair) - reference_rad); });
}

Vec3 medianTranslation(const RingBuffer<AlignmentPair>& pairs, double heading_rad, std::size_t first = 0) {
  const NedFromWorld turned(heading_rad, Vec3::Zero());
  const auto offset_m = [&](const AlignmentPair& pair) -> Vec3 {
    return pair.position_NED_m - turned.point(pair.position_W_m);
  };
  Vec3 translation_m;
  for (int axis = 0; axis < 3; ++axis) {
    translation_m[axis] = medianOf(
        pairs, [&](const AlignmentPair& pair) { return offset_m(pair)[axis]; }, first);
  }
  return translation_m;
}

/// How the tracks correct a heading, and how much they know about it.
struct TrackHeading {
  double correction_rad = 0.0;
  double information = 0.0;  ///< 1 / rad^2
};

TrackHeading headingByTracks(const RingBuffer<AlignmentPair>& pairs, const NedFromWorld& T_NED_W, double sigma_m) {
  // What is off by more than the sigma loses weight faster than it gains leverage: a gross outlier has no say.
  double sum = 0.0;
  Vec3 mean_NED = Vec3::Zero();
  Vec3 mean_turned = Vec3::Zero();
  const auto weightOf = [&](const AlignmentPair& pair) {
    const double share = sigma_m / std::max(residualsOf(pair, T_NED_W).position_m, sigma_m);
    return share * share;
  };
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double weight = weightOf(pairs[i]);
    sum += weight;
    mean_NED += weight * pairs[i].position_NED_m;
    mean_turned += weight * T_NED_W.point(pairs[i].position_W_m);
  }
  mean_NED /= sum;
  mean_turned /= sum;
  // Horizontal vectors as complex numbers: the argument of this sum is the turn that is missing between the tracks.
  std::complex<double> turn = 0.0;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const Vec3 d_NED = pairs[i].position_NED_m - mean_NED;
    const Vec3 d_turned = T_NED_W.point(pairs[i].position_W_m) - mean_turned;
    turn +=
        weightOf(pairs[i]) * std::complex(d_NED.x(), d_NED.y()) * std::conj(std::complex(d_turned.x(), d_turned.y()));
  }
  return {std::arg(turn), std::abs(turn) / sum / (sigma_m * sigma_m)};
}

}  // namespace

NedFromWorld fitAlignment(const RingBuffer<AlignmentPair>& pairs, const AlignmentWeights& weights) {
  const double by_attitude_rad = headingByAttitude(pairs);
  const double attitude_information = 1.0 / (weights.attitude_sigma_rad * weights.attitude_sigma_rad);
  NedFromWorld T_NED_W(by_attitude_rad, medianTranslation(pairs, by_attitude_rad));
  // The weights of the tracks follow from what they correct: a few rounds, after which nothing changes any more.
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const TrackHeading tracks = headingByTracks(pairs, T_NED_W, weights.position_sigma_m);
    const double off_attitude_rad = wrapAngle(T_NED_W.heading_rad() + tracks.correction_rad - by_attitude_rad);
    const double share = tracks.information / (tracks.information + attitude_information);
    const double heading_rad = by_attitude_rad + share * off_attitude_rad;
    T_NED_W = NedFromWorld(heading_rad, medianTranslation(pairs, heading_rad));
  }
  return T_NED_W;
}

NedFromWorld placedByNewest(const RingBuffer<AlignmentPair>& pairs, double heading_rad, Duration window) {
  std::size_t first = pairs.size() - 1;
  while (first > 0 && pairs.back().stamp - pairs[first - 1].stamp <= window) --first;
  return {heading_rad, medianTranslation(pairs, heading_rad, first)};
}

AlignmentResiduals residualsOf(const AlignmentPair& pair, const NedFromWorld& T_NED_W) {
  return {(pair.position_NED_m - T_NED_W.point(pair.position_W_m)).norm(),
          std::abs(wrapAngle(pair.heading_NED_rad - T_NED_W.heading(pair.yaw_W_rad)))};
}

AlignmentResiduals medianResiduals(const RingBuffer<AlignmentPair>& pairs, const NedFromWorld& T_NED_W) {
  return {medianOf(pairs, [&](const AlignmentPair& pair) { return residualsOf(pair, T_NED_W).position_m; }),
          medianOf(pairs, [&](const AlignmentPair& pair) { return residualsOf(pair, T_NED_W).heading_rad; })};
}

}  // namespace nanomap
