#include "tools/sim/flight_judge.h"

#include <algorithm>

namespace nanomap::sim {
namespace {

/// The speed below which a vehicle stands.
constexpr double kStandstill_m_s = 0.2;

/// Hovering sways, and drift is followed: whoever is farther away, as seen from above, has left.
constexpr double kLeft_m = 1.0;

}  // namespace

std::string_view toString(Outcome outcome) {
  switch (outcome) {
    case Outcome::kUnderWay:
      return "still under way";
    case Outcome::kAtGoal:
      return "at the goal";
    case Outcome::kCollision:
      return "collision";
  }
  return "?";
}

void FlightJudge::see(Time stamp, const simulation::VehicleState& truth, bool arrived) {
  const Vec3& p_W = truth.T_W_B.translation_m;
  const double clearance_m = std::min(scene_.distanceToNearestObstacle(p_W), p_W.z());
  if (verdict_.outcome == Outcome::kCollision) return;
  if (verdict_.outcome == Outcome::kUnderWay) verdict_.end = stamp;
  if (!began_W_) {
    if (clearance_m < radius_m_) return;
    began_W_ = p_W;
  }
  if (verdict_.departure && verdict_.outcome == Outcome::kUnderWay) verdict_.flown_m += (p_W - last_W_).norm();
  last_W_ = p_W;
  const double speed_m_s = truth.velocity_W_m_s.norm();
  verdict_.top_speed_m_s = std::max(verdict_.top_speed_m_s, speed_m_s);
  if (!verdict_.departure && (p_W - *began_W_).head<2>().norm() > kLeft_m) verdict_.departure = stamp;
  if (verdict_.departure) verdict_.min_clearance_m = std::min(verdict_.min_clearance_m, clearance_m);
  if (clearance_m < radius_m_) {
    verdict_.outcome = Outcome::kCollision;
    verdict_.end = stamp;
  } else if (arrived && speed_m_s < kStandstill_m_s) {
    verdict_.outcome = Outcome::kAtGoal;
  }
}

}  // namespace nanomap::sim
