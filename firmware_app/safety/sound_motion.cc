#include "firmware_app/safety/sound_motion.h"

#include <algorithm>
#include <cmath>

namespace nanomap {
namespace {

constexpr double kRounding = 1e-6;  ///< relative, and in m/s for what should be at rest

bool isFinite(const Motion& motion) {
  return motion.position_m.allFinite() && motion.velocity_m_s.allFinite() && motion.acceleration_m_s2.allFinite();
}

}  // namespace

bool isSound(const Decision& decision, const MotionLimits& limits) {
  const Trajectory& motion = decision.brake;
  const Motion& start = motion.atStart();
  if (!isFinite(start) || !std::isfinite(decision.yaw_W_rad)) return false;

  // Between two ends of pieces the acceleration is linear: it is largest at one of them.
  const double planned_m_s2 = std::hypot(limits.horizontal_at_full_m_s2, limits.vertical_m_s2);
  const double most_m_s2 = (1.0 + kRounding) * std::max(planned_m_s2, start.acceleration_m_s2.norm());
  const double most_m_s3 = (1.0 + kRounding) * limits.jerk_m_s3;
  double elapsed_s = 0.0;
  for (const Trajectory::Piece& piece : motion.pieces()) {
    elapsed_s += piece.duration_s;
    // What is not a number is not at most anything.
    if (!(piece.duration_s >= 0.0) || !(piece.jerk_W_m_s3.norm() <= most_m_s3)) return false;
    if (!(motion.sample(elapsed_s).acceleration_m_s2.norm() <= most_m_s2)) return false;
  }
  const Motion end = motion.atEnd();
  return isFinite(end) && end.velocity_m_s.norm() <= kRounding * (1.0 + start.velocity_m_s.norm());
}

}  // namespace nanomap
