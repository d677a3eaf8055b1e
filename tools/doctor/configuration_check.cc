#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <string>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "configuration";

/// Collects what is suspicious.
class Suspicions {
 public:
  void add(bool suspicious, std::string seen, std::string fix) {
    if (suspicious) findings_.push_back(warning(kSubject, std::move(seen), std::move(fix)));
  }
  [[nodiscard]] Findings take() { return std::move(findings_); }

 private:
  Findings findings_;
};

void checkCameraSection(const CameraParameters& camera, Suspicions& suspicions) {
  constexpr double kUnequalFocal = 0.5;
  constexpr double kMiddle = 0.2;
  constexpr double kNarrowest_deg = 30.0;
  constexpr double kWidest_deg = 150.0;
  constexpr double kFarthest_m = 40.0;
  const double across_deg = 2.0 * std::atan(camera.width_px / 2.0 / camera.fx_px) * 180.0 / std::numbers::pi;
  suspicions.add(across_deg < kNarrowest_deg || across_deg > kWidest_deg,
                 fmt::format("camera.fx_px = {:g} and width_px = {}: it would see {:.0f} degrees", camera.fx_px,
                             camera.width_px, across_deg),
                 "take the intrinsics of the stream as it is sent, not of another resolution");
  suspicions.add(std::abs(camera.fx_px / camera.fy_px - 1.0) > kUnequalFocal && camera.distortion.isZero(),
                 fmt::format("camera.fx_px = {:g}, fy_px = {:g}: pixels are rarely that far from square", camera.fx_px,
                             camera.fy_px),
                 "check camera.fx_px and camera.fy_px");
  suspicions.add(std::abs(camera.cx_px / camera.width_px - 0.5) > kMiddle ||
                     std::abs(camera.cy_px / camera.height_px - 0.5) > kMiddle,
                 fmt::format("camera.cx_px = {:g}, cy_px = {:g}: far from the middle of {}x{}", camera.cx_px,
                             camera.cy_px, camera.width_px, camera.height_px),
                 "take the intrinsics of the stream as it is sent, not of another resolution");
  suspicions.add(camera.max_range_m > kFarthest_m,
                 fmt::format("camera.max_range_m = {:g}: farther than depth cameras of drones see", camera.max_range_m),
                 "camera.max_range_m: up to where depths are right within a few percent, 10 .. 20 m say");
}

void checkPlannerSections(const PlannerParameters& planner, Suspicions& suspicions) {
  constexpr double kLargestRisk = 0.01;
  constexpr double kVeto = 0.1;
  suspicions.add(planner.risk.max_risk > kLargestRisk,
                 fmt::format("risk.max_risk = {:g}: a collision in {:.0f} motions", planner.risk.max_risk,
                             1.0 / planner.risk.max_risk),
                 "risk.max_risk = 0.001");
  suspicions.add(planner.stop_check == StopCheck::kPaper,
                 "planner.stop_check = \"paper\": plans carry no brake to fly when something fails",
                 "planner.stop_check = \"verified\"");
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    const auto status = static_cast<Status>(i);
    if (status == Status::kFree || status == Status::kOpen) continue;
    suspicions.add(planner.risk.prior[i] < kVeto,
                   fmt::format("the [risk] prior of '{}' is {:g}: it flies where nothing was seen to be free",
                               toString(status), planner.risk.prior[i]),
                   "leave it at 1");
  }
}

void checkDrift(const DriftModel& drift, Suspicions& suspicions) {
  suspicions.add(drift.horizontal_std_m == 0.0 && !drift.use_increments,
                 "drift.horizontal_std_m = 0: old views are believed as if the estimator never drifted",
                 "drift.horizontal_std_m: how far relative position wanders in drift.after_s, 0.2 m in 5 s say");
}

void checkSafety(const SafetyParameters& safety, Suspicions& suspicions) {
  constexpr Duration kLongest = std::chrono::seconds(1);
  const auto add = [&](const char* key, Duration age) {
    suspicions.add(age > kLongest, fmt::format("safety.{} = {:g}: it flies blind for so long", key, toSeconds(age)),
                   fmt::format("safety.{} = 0.2", key));
  };
  add("max_plan_age_s", safety.max_plan_age);
  add("max_depth_age_s", safety.max_depth_age);
  add("max_pose_age_s", safety.max_pose_age);
}

}  // namespace

Findings checkConfiguration(const Facts& facts) {
  const Configuration& configuration = facts.configuration;
  Suspicions suspicions;
  if (configuration.camera) checkCameraSection(*configuration.camera, suspicions);
  checkPlannerSections(configuration.planner, suspicions);
  checkDrift(configuration.chain.drift, suspicions);
  checkSafety(configuration.safety, suspicions);
  Findings findings = suspicions.take();
  if (configuration.lcm.clock == ClockDomain::kLog && !(facts.heard && facts.heard->from_log)) {
    findings.push_back(failure(kSubject, "lcm.clock = \"log\": what is played back is never flown",
                               "lcm.clock = \"monotonic\" or \"realtime\", as the senders stamp"));
  }
  if (findings.empty()) findings.push_back(ok(kSubject, facts.configuration_origin));
  return findings;
}

}  // namespace nanomap::doctor
