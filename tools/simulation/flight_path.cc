#include "tools/simulation/flight_path.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>

#include "tools/simulation/attitude.h"
#include "tools/simulation/random.h"
#include "tools/simulation/route.h"
#include "tools/simulation/smoothing.h"
#include "tools/simulation/speed_profile.h"

namespace nanomap::simulation {
namespace {

using Vec2 = Eigen::Vector2d;
using std::numbers::pi;

constexpr double kPathStep_m = 0.05;
constexpr double kSamplePeriod_s = 0.002;
constexpr std::size_t kTiltHalfWidth = 40;  // samples: 80 ms, how fast a quadrotor of this size changes its tilt
constexpr std::size_t kYawHalfWidth = 75;   // samples: yaw has less authority

/// Points every kPathStep_m along the polyline, both ends included.
std::vector<Vec2> resample(const std::vector<Vec2>& polyline_m) {
  std::vector<Vec2> points_m = {polyline_m.front()};
  double to_next_m = kPathStep_m;
  for (std::size_t i = 1; i < polyline_m.size(); ++i) {
    const Vec2 leg_m = polyline_m[i] - polyline_m[i - 1];
    const double length_m = leg_m.norm();
    for (; to_next_m <= length_m; to_next_m += kPathStep_m) {
      points_m.emplace_back(polyline_m[i - 1] + leg_m * (to_next_m / length_m));
    }
    to_next_m -= length_m;
  }
  return points_m;
}

/// Direction of the path at each point [rad], continuous across +-pi, measured over some points to both sides.
std::vector<double> headings(const std::vector<Vec2>& points_m) {
  constexpr std::size_t kReach = 5;
  std::vector<double> heading_rad(points_m.size());
  for (std::size_t i = 0; i < points_m.size(); ++i) {
    const Vec2 ahead_m = points_m[std::min(i + kReach, points_m.size() - 1)];
    const Vec2 span_m = ahead_m - points_m[i - std::min(i, kReach)];
    heading_rad[i] = std::atan2(span_m.y(), span_m.x());
    if (i > 0) heading_rad[i] = heading_rad[i - 1] + std::remainder(heading_rad[i] - heading_rad[i - 1], 2.0 * pi);
  }
  return heading_rad;
}

std::vector<double> curvatures(const std::vector<double>& heading_rad) {
  constexpr std::size_t kReach = 4;
  std::vector<double> curvature_per_m(heading_rad.size());
  for (std::size_t i = 0; i < heading_rad.size(); ++i) {
    const std::size_t from = i - std::min(i, kReach);
    const std::size_t to = std::min(i + kReach, heading_rad.size() - 1);
    curvature_per_m[i] = (heading_rad[to] - heading_rad[from]) / (static_cast<double>(to - from) * kPathStep_m);
  }
  return curvature_per_m;
}

/// The pilot's mood: legs at different speeds, some of which end with a hard brake to a crawl.
std::vector<double> wantedSpeeds(std::size_t points, double cruise_speed_m_s, Random& random) {
  constexpr double kBrakeShare = 0.4;
  constexpr double kCrawlShare = 0.25;
  constexpr double kCrawl_m = 1.0;
  std::vector<double> wanted_m_s;
  while (wanted_m_s.size() < points) {
    const double leg_m = uniform(random, 15.0, 35.0);
    const double leg_speed_m_s = cruise_speed_m_s * uniform(random, 0.75, 1.0);
    const bool brakes = chance(random, kBrakeShare);
    wanted_m_s.insert(wanted_m_s.end(), static_cast<std::size_t>(leg_m / kPathStep_m), leg_speed_m_s);
    if (brakes) {
      wanted_m_s.insert(wanted_m_s.end(), static_cast<std::size_t>(kCrawl_m / kPathStep_m),
                        kCrawlShare * cruise_speed_m_s);
    }
  }
  wanted_m_s.resize(points);
  return wanted_m_s;
}

/// Altitude at a share of the way: from start to goal, in gentle waves that fade at both ends.
double altitude(const Mission& mission, double way_m, double length_m) {
  constexpr double kWaveHeight_m = 0.3;
  constexpr double kWaveLength_m = 25.0;
  const double share = way_m / length_m;
  const double fade = std::sin(pi * share) * std::sin(pi * share);
  return mission.start_W.z() + share * (mission.goal_W.z() - mission.start_W.z()) +
         fade * kWaveHeight_m * std::sin(2.0 * pi * way_m / kWaveLength_m);
}

struct Sample {
  Vec3 position_W;
  double heading_rad;
};

/// Follows the path at its speeds: one sample a period, standing still long enough at both ends for smoothing.
std::vector<Sample> follow(const Mission& mission, const std::vector<Vec2>& points_m,
                           const std::vector<double>& heading_rad, const std::vector<double>& speed_m_s) {
  constexpr std::size_t kStandstill = 4 * kYawHalfWidth;
  const double length_m = static_cast<double>(points_m.size() - 1) * kPathStep_m;
  const auto sampleAt = [&](std::size_t i, double share) -> Sample {
    const std::size_t next = std::min(i + 1, points_m.size() - 1);
    const Vec2 position_m = points_m[i] + share * (points_m[next] - points_m[i]);
    const double altitude_m = altitude(mission, (static_cast<double>(i) + share) * kPathStep_m, length_m);
    return {{position_m.x(), position_m.y(), altitude_m},
            heading_rad[i] + share * (heading_rad[next] - heading_rad[i])};
  };
  std::vector<Sample> samples(kStandstill, sampleAt(0, 0.0));
  double entered_s = 0.0;  // when the current step of the path was entered
  double now_s = 0.0;
  for (std::size_t i = 0; i + 1 < points_m.size(); ++i) {
    const double step_s = 2.0 * kPathStep_m / (speed_m_s[i] + speed_m_s[i + 1]);
    const double acceleration_m_s2 = (speed_m_s[i + 1] - speed_m_s[i]) / step_s;
    for (; now_s < entered_s + step_s; now_s += kSamplePeriod_s) {
      const double since_s = now_s - entered_s;
      const double gone_m = speed_m_s[i] * since_s + acceleration_m_s2 * since_s * since_s / 2.0;
      samples.push_back(sampleAt(i, std::clamp(gone_m / kPathStep_m, 0.0, 1.0)));
    }
    entered_s += step_s;
  }
  samples.insert(samples.end(), kStandstill, sampleAt(points_m.size() - 1, 0.0));
  return samples;
}

/// States with the derivatives that belong to the positions.
std::vector<VehicleState> differentiate(const std::vector<Vec3>& position_W, const std::vector<double>& yaw_rad) {
  std::vector<VehicleState> states;
  states.reserve(position_W.size());
  for (std::size_t i = 1; i + 1 < position_W.size(); ++i) {
    VehicleState state;
    state.velocity_W_m_s = (position_W[i + 1] - position_W[i - 1]) / (2.0 * kSamplePeriod_s);
    state.acceleration_W_m_s2 =
        (position_W[i + 1] - 2.0 * position_W[i] + position_W[i - 1]) / (kSamplePeriod_s * kSamplePeriod_s);
    state.T_W_B = {attitudeFor(state.acceleration_W_m_s2, yaw_rad[i]), position_W[i]};
    states.push_back(state);
  }
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const Eigen::AngleAxisd turn(states[i].T_W_B.rotation.conjugate() * states[i + 1].T_W_B.rotation);
    states[i].angular_rate_B_rad_s = std::remainder(turn.angle(), 2.0 * pi) / kSamplePeriod_s * turn.axis();
  }
  return states;
}

std::vector<VehicleState> fly(const Mission& mission, const std::vector<Vec2>& points_m,
                              const FlightParameters& parameters, Random random) {
  // Climbing and sinking take a little of the tilt.
  constexpr double kHorizontalShare = 0.9;
  constexpr double kSpeedUpShare = 0.6;
  const double acceleration_m_s2 = kHorizontalShare * kGravity_m_s2 * std::tan(parameters.max_tilt_rad);
  const std::vector<double> heading_rad = headings(points_m);
  const std::vector<double> speed_m_s = speedProfile(kPathStep_m, curvatures(heading_rad),
                                                     wantedSpeeds(points_m.size(), parameters.cruise_speed_m_s, random),
                                                     {.max_acceleration_m_s2 = acceleration_m_s2,
                                                      .max_speed_up_m_s2 = kSpeedUpShare * acceleration_m_s2,
                                                      .max_yaw_rate_rad_s = parameters.max_yaw_rate_rad_s});
  std::vector<Vec3> position_W;
  std::vector<double> yaw_rad;
  for (const Sample& sample : follow(mission, points_m, heading_rad, speed_m_s)) {
    position_W.push_back(sample.position_W);
    yaw_rad.push_back(sample.heading_rad);
  }
  return differentiate(smooth(std::move(position_W), kTiltHalfWidth), smooth(std::move(yaw_rad), kYawHalfWidth));
}

bool keepsClear(const std::vector<VehicleState>& states, const Scene& scene, double clearance_m) {
  constexpr std::size_t kStride = 5;  // 10 ms: some centimetres
  for (std::size_t i = 0; i < states.size(); i += kStride) {
    if (scene.distanceToNearestObstacle(states[i].T_W_B.translation_m) < clearance_m) return false;
  }
  return true;
}

}  // namespace

FlightPath::FlightPath(const Scene& scene, const FlightParameters& parameters, std::uint64_t seed) {
  const auto requirePositive = [](double value, const char* name) {
    if (value > 0.0) return;
    throw std::invalid_argument(std::string("flight: ") + name + " is " + std::to_string(value) + ", must be positive");
  };
  requirePositive(parameters.cruise_speed_m_s, "cruise_speed_m_s");
  requirePositive(parameters.max_tilt_rad, "max_tilt_rad");
  requirePositive(parameters.max_yaw_rate_rad_s, "max_yaw_rate_rad_s");
  requirePositive(parameters.min_clearance_m, "min_clearance_m");
  if ((scene.mission().goal_W - scene.mission().start_W).head<2>().norm() < kPathStep_m) {
    throw std::invalid_argument("flight: the goal of the scene '" + scene.name() + "' is its start");
  }
  // Smoothing cuts corners: plan with room to spare and round generously, then with less of both.
  for (const double spare_m : {0.5, 0.3, 0.15}) {
    const std::optional<std::vector<Vec2>> route_m = planRoute(scene, parameters.min_clearance_m + spare_m);
    if (!route_m) continue;
    for (const double rounding_m : {8.0, 5.0, 3.0, 1.5}) {
      constexpr double kWindowsInSupport = 6.0;  // three passes, two half windows each
      const auto half_width = static_cast<std::size_t>(rounding_m / kWindowsInSupport / kPathStep_m);
      states_ = fly(scene.mission(), resample(smooth(resample(*route_m), half_width)), parameters, Random(seed));
      if (keepsClear(states_, scene, parameters.min_clearance_m)) return;
    }
  }
  throw std::runtime_error("flight: no way through the scene '" + scene.name() + "' keeps " +
                           std::to_string(parameters.min_clearance_m) + " m of clearance; try another seed");
}

Duration FlightPath::duration() const { return fromSeconds(static_cast<double>(states_.size() - 1) * kSamplePeriod_s); }

VehicleState FlightPath::at(Duration elapsed) const {
  const double sample = std::clamp(toSeconds(elapsed) / kSamplePeriod_s, 0.0, static_cast<double>(states_.size() - 1));
  const auto i = std::min(static_cast<std::size_t>(sample), states_.size() - 2);
  const double weight = sample - static_cast<double>(i);
  const VehicleState& before = states_[i];
  const VehicleState& after = states_[i + 1];
  const auto blend = [&](const Vec3& from, const Vec3& to) -> Vec3 { return from + weight * (to - from); };
  return {interpolate(before.T_W_B, after.T_W_B, weight), blend(before.velocity_W_m_s, after.velocity_W_m_s),
          blend(before.acceleration_W_m_s2, after.acceleration_W_m_s2),
          blend(before.angular_rate_B_rad_s, after.angular_rate_B_rad_s)};
}

}  // namespace nanomap::simulation
