#include <fmt/format.h>

#include <cmath>
#include <string>

#include "firmware_app/configuration/camera_mount.h"
#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "mount";

std::string fixOf(const Facts& facts, const Hypothesis& mount) {
  const auto tidy = [](double angle_deg) { return std::round(angle_deg * 10.0) / 10.0 + 0.0; };
  const MountAngles angles = anglesOfMount(mount.trial.T_B_C.rotation);
  const std::string key = fmt::format("camera.mount_roll_pitch_yaw_deg = [{:g}, {:g}, {:g}]", tidy(angles.roll_deg),
                                      tidy(angles.pitch_deg), tidy(angles.yaw_deg));
  if (facts.configuration.camera) return key;
  Quat q = mount.trial.T_B_C.rotation;
  if (q.w() < 0.0) q.coeffs() = -q.coeffs();  // the same rotation, as people write it
  return fmt::format(
      "in the camera's message body_from_camera.rotation = [{:.4g}, {:.4g}, {:.4g}, {:.4g}] (w, x, y, z); "
      "or in [camera], {}",
      q.w(), q.x(), q.y(), q.z(), key);
}

}  // namespace

Findings checkMount(const Facts& facts, const MotionEvidence& evidence) {
  constexpr double kPoor = 0.4;
  if (!evidence.configured) {
    return {notLookedAt(kSubject, fmt::format("the vehicle did not move enough while a camera looked ({} pairs of "
                                              "frames): carry it a metre, turning it, or give a log of a flight",
                                              evidence.pairs))};
  }
  const double share = evidence.configured->agreement * 100.0;
  const Hypothesis* better = evidence.better();
  if (better && better->kind == Hypothesis::Kind::kMount) {
    return {failure(kSubject,
                    fmt::format("as the vehicle moves, {:.0f} % of the depths agree with those before; {:.0f} % if {}",
                                share, better->agreement * 100.0, better->text),
                    fixOf(facts, *better))};
  }
  if (better && better->kind == Hypothesis::Kind::kStamps) {
    return {failure("clock",
                    fmt::format("as the vehicle moves, {:.0f} % of the depths agree with those before; {:.0f} % if "
                                "frames are taken {:.2f} s {}",
                                share, better->agreement * 100.0, std::abs(toSeconds(better->stamp_shift)),
                                better->stamp_shift > Duration::zero() ? "later than stamped" : "earlier than stamped"),
                    "stamp frames at their exposure and poses at the moment that they are of, by one clock")};
  }
  if (const Hypothesis* nearby = evidence.nearbyMount()) {
    return {warning(kSubject,
                    fmt::format("as the vehicle moves, {:.0f} % of the depths agree with those before; {:.0f} % if {}",
                                share, nearby->agreement * 100.0, nearby->text),
                    fixOf(facts, *nearby) + ", within a degree or so: measure it")};
  }
  const std::string seen = fmt::format(
      "as the vehicle moves, {:.0f} % of the depths agree with those before ({} pairs)", share, evidence.pairs);
  if (!better && evidence.configured->agreement < kPoor) {
    return {warning(kSubject, seen + ", and with no mount that was tried clearly more",
                    "check intrinsics, mount and poses; things that move, or noise, have the same effect")};
  }
  return {ok(kSubject, seen)};
}

}  // namespace nanomap::doctor
