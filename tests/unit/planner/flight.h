#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "core/chain.h"
#include "planner/planner.h"
#include "planner/receding_horizon.h"
#include "tests/support/drawn_world.h"

namespace nanomap::test {

/// A wide camera with sky and ground in view: 90 by 74 degrees, 15 m.
inline CameraParameters flightCamera() {
  CameraParameters camera = smallCamera(96, 72);
  camera.max_range_m = 15.0;
  return camera;
}

/// Defaults, but for the window that tells sky from a hole: the angle that the default spans in 320 pixels; and
/// without detours.
inline PlannerParameters flightParameters() {
  PlannerParameters parameters;
  parameters.risk.query.open_window_px = 10;
  parameters.detour.give_up_after = Duration::zero();
  return parameters;
}

inline Goal goalAt(const Vec3& position_W_m, double top_speed_m_s = 4.0) {
  Goal goal;
  goal.sequence = 7;
  goal.position_W_m = position_W_m;
  goal.top_speed_m_s = top_speed_m_s;
  return goal;
}

/// The attitude of a multirotor that accelerates like that: its thrust carries it.
inline Quat attitude(double yaw_W_rad, const Vec3& acceleration_W_m_s2) {
  constexpr double kGravity_m_s2 = 9.81;
  const Vec3 up_W = (acceleration_W_m_s2 + Vec3(0.0, 0.0, kGravity_m_s2)).normalized();
  const Vec3 left_W = up_W.cross(Vec3(std::cos(yaw_W_rad), std::sin(yaw_W_rad), 0.0)).normalized();
  Mat3 R_W_B;
  R_W_B << left_W.cross(up_W), left_W, up_W;
  return Quat(R_W_B).normalized();
}

/// A vehicle in a drawn world that sees, plans and follows its plan exactly, 15 times a second.
class Flight {
 public:
  Flight(DrawnWorld world, const Vec3& start_W_m, double yaw_W_rad,
         const PlannerParameters& parameters = flightParameters(), CameraParameters camera = flightCamera())
      : world_(std::move(world)),
        camera_(model(std::move(camera))),
        planner_(parameters),
        horizon_(parameters),
        chain_(chainParameters()),
        yaw_W_rad_(yaw_W_rad) {
    motion_W_.position_m = start_W_m;
  }

  /// Looks, plans, and follows the plan until the next step.
  Decision step(const std::optional<Goal>& goal) {
    look();
    const Decision decision = horizon_.step(snapshot_, state(), goal, now_);
    if (horizon_.inForce()) motion_W_ = follow(*horizon_.inForce(), decision);
    yaw_W_rad_ += decision.yaw_rate_rad_s * toSeconds(kPeriod);
    now_ += kPeriod;
    fastest_m_s_ = std::max(fastest_m_s_, motion_W_.velocity_m_s.norm());
    least_clearance_m_ = std::min(least_clearance_m_, world_.clearance_m(motion_W_.position_m));
    return decision;
  }

  std::vector<Decision> fly(const std::optional<Goal>& goal, double duration_s) {
    std::vector<Decision> decisions;
    for (const Time end = now_ + fromSeconds(duration_s); now_ < end;) decisions.push_back(step(goal));
    return decisions;
  }

  /// Takes an image from where it is.
  void look() {
    BodyPose pose;
    pose.stamp = now_;
    pose.T_W_B = state().T_W_B;
    pose.sequence = sequence_;
    (void)chain_.addPose(pose);
    DepthImage image = world_.seenBy(*camera_, pose.T_W_B, now_);
    image.sequence = sequence_++;
    (void)chain_.addView(viewOf(std::move(image), camera_));
    snapshot_ = chain_.snapshot();
  }

  [[nodiscard]] VehicleState state() const {
    VehicleState state;
    state.stamp = now_;
    state.sequence = sequence_;
    state.T_W_B = {attitude(yaw_W_rad_, motion_W_.acceleration_m_s2), motion_W_.position_m};
    state.velocity_W_m_s = motion_W_.velocity_m_s;
    state.acceleration_W_m_s2 = motion_W_.acceleration_m_s2;
    return state;
  }

  void setMotion(const Motion& motion_W) { motion_W_ = motion_W; }

  [[nodiscard]] const Motion& motion() const { return motion_W_; }
  [[nodiscard]] const ChainSnapshot& snapshot() const { return snapshot_; }
  [[nodiscard]] const Planner& planner() const { return planner_; }
  [[nodiscard]] Time now() const { return now_; }
  [[nodiscard]] double yaw_W_rad() const { return yaw_W_rad_; }
  [[nodiscard]] double fastest_m_s() const { return fastest_m_s_; }
  [[nodiscard]] double leastClearance_m() const { return least_clearance_m_; }

 private:
  static constexpr Duration kPeriod = std::chrono::microseconds(66'666);

  static ChainParameters chainParameters() {
    ChainParameters parameters;
    parameters.history_views = 75;
    parameters.drift = {.horizontal_std_m = 0.3, .vertical_std_m = 0.1};
    return parameters;
  }

  /// The plan while it is the newest, its brake once a later one could verify nothing.
  [[nodiscard]] Motion follow(const Decision& in_force, const Decision& newest) const {
    const bool fresh = in_force.stamp == newest.stamp;
    return (fresh ? in_force.trajectory : in_force.brake).sample(now_ + kPeriod);
  }

  DrawnWorld world_;
  std::shared_ptr<const CameraModel> camera_;
  Planner planner_;
  RecedingHorizon horizon_;
  Chain chain_;
  ChainSnapshot snapshot_;
  Motion motion_W_;
  double yaw_W_rad_;
  Time now_ = Time(std::chrono::milliseconds(999'900));
  std::uint64_t sequence_ = 0;
  double fastest_m_s_ = 0.0;
  double least_clearance_m_ = std::numeric_limits<double>::infinity();
};

}  // namespace nanomap::test
