#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tools/doctor/checks.h"
#include "tools/doctor/mount_fix.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "mount";
constexpr const char* kMove = "carry it a metre, turning it, or give a log of a flight";

/// The mount under which the plane is level, and by how much the configured one is off it.
struct LevelMount {
  LevelMount(const FloorEvidence& evidence, const Quat& R_B_C_configured) {
    const Quat R_B_W = R_B_C_configured * evidence.R_W_C.conjugate();
    const Eigen::AngleAxisd turn_B(R_B_W * evidence.turnToLevel_W() * R_B_W.conjugate());
    constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
    R_B_C = turn_B * R_B_C_configured;
    tilt_deg = turn_B.angle() * kDegreesPerRadian;
    const Vec3 off_deg = tilt_deg * turn_B.axis();
    words = fmt::format("{:+.0f} degrees of roll and {:+.0f} of pitch", off_deg.x() + 0.0, off_deg.y() + 0.0);
  }

  Quat R_B_C;
  double tilt_deg = 0.0;
  std::string words;
};

Finding judgeBelow(const Facts& facts, const LevelMount& level, double share) {
  constexpr double kSloping_deg = 5.0;
  constexpr double kTilted_deg = 12.0;
  const std::string floor = fmt::format("the vehicle stands: the floor, {:.0f} % of the depths,", share * 100.0);
  if (level.tilt_deg <= kSloping_deg) {
    return ok(kSubject, fmt::format("{} is level within {:.0f} degrees; where ahead is shows only as it moves", floor,
                                    std::ceil(level.tilt_deg)));
  }
  const std::string tilted = fmt::format("{} is {:.0f} degrees off level, and level if the camera is turned by {}",
                                         floor, level.tilt_deg, level.words);
  if (level.tilt_deg <= kTilted_deg) {
    return warning(kSubject, tilted, "if the ground does not slope there, " + mountFix(facts, level.R_B_C));
  }
  return failure(kSubject, tilted, mountFix(facts, level.R_B_C));
}

}  // namespace

Findings checkMountAtRest(const Facts& facts, const FloorEvidence& evidence) {
  using Kind = FloorEvidence::Kind;
  const auto skipped = [](const char* why) {
    return Findings{notLookedAt(kSubject, fmt::format("{}: {}", why, kMove))};
  };
  if (evidence.kind == Kind::kNoPicture)
    return skipped("the vehicle stands, and hardly a depth is in range and has a pose");
  if (evidence.kind == Kind::kNoFloor)
    return skipped("the vehicle stands, and sees no floor that tells which way is up");

  const LevelMount level(evidence, facts.camera()->T_B_C.rotation);
  const double share = evidence.plane.share;
  if (evidence.kind == Kind::kBelow) return {judgeBelow(facts, level, share)};
  if (evidence.kind == Kind::kAmbiguous) {
    return {
        notLookedAt(kSubject, fmt::format("the vehicle stands: the largest plane, {:.0f} % of the depths, is a wall, "
                                          "or the floor if the camera is turned by {}: {}",
                                          share * 100.0, level.words, kMove))};
  }
  return {
      failure(kSubject,
              fmt::format("the vehicle stands: what looks like the floor, {:.0f} % of the depths, would be level if "
                          "the camera were turned by {}",
                          share * 100.0, level.words),
              mountFix(facts, level.R_B_C) + "; or, if that is a wall, let it see the floor")};
}

}  // namespace nanomap::doctor
