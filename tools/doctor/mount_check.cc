#include <fmt/format.h>

#include <cmath>
#include <string>

#include "tools/doctor/checks.h"
#include "tools/doctor/mount_fix.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "mount";

}  // namespace

Findings checkMount(const Facts& facts, const MotionEvidence& evidence) {
  constexpr double kPoor = 0.4;
  const double share = evidence.configured->agreement * 100.0;
  const Hypothesis* better = evidence.better();
  if (better && better->kind == Hypothesis::Kind::kMount) {
    return {failure(kSubject,
                    fmt::format("as the vehicle moves, {:.0f} % of the depths agree with those before; {:.0f} % if {}",
                                share, better->agreement * 100.0, better->text),
                    mountFix(facts, better->trial.T_B_C.rotation))};
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
                    mountFix(facts, nearby->trial.T_B_C.rotation) + ", within a degree or so: measure it")};
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
