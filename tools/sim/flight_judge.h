#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "core/time.h"
#include "tools/simulation/scene.h"
#include "tools/simulation/vehicle_state.h"

namespace nanomap::sim {

enum class Outcome : std::uint8_t {
  kUnderWay,
  kAtGoal,     ///< stands there
  kCollision,  ///< the sphere that holds the vehicle touched something
};

[[nodiscard]] std::string_view toString(Outcome outcome);

/// A vehicle stands this far from where its plan ends, or less.
inline constexpr double kTrackingAllowance_m = 0.3;

struct FlightVerdict {
  Outcome outcome = Outcome::kUnderWay;
  Time end{};                     ///< of the outcome, or the last moment seen
  std::optional<Time> departure;  ///< when it left its start
  double flown_m = 0.0;           ///< since then
  /// Of its centre, to obstacles and ground, since then: a take-off begins near the ground.
  double min_clearance_m = std::numeric_limits<double>::infinity();
  double top_speed_m_s = 0.0;
};

/// Watches the true motion of a vehicle through a scene. A vehicle that still stands on the ground is none that flies:
/// it is judged from when its sphere is clear of everything for the first time. Threads: one.
class FlightJudge {
 public:
  /// @param scene     must outlive the judge
  /// @param radius_m  of the sphere that holds the vehicle
  FlightJudge(const simulation::Scene& scene, double radius_m) : scene_(scene), radius_m_(radius_m) {}

  /// @param arrived  the vehicle believes that it is at the goal
  void see(Time stamp, const simulation::VehicleState& truth, bool arrived);

  [[nodiscard]] const FlightVerdict& verdict() const { return verdict_; }

 private:
  const simulation::Scene& scene_;
  double radius_m_;
  std::optional<Vec3> began_W_;  ///< where it was when it was clear of everything
  Vec3 last_W_ = Vec3::Zero();   ///< where it was seen last
  FlightVerdict verdict_;
};

}  // namespace nanomap::sim
