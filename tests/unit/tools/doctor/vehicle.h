#pragma once

#include <string>

#include "tests/support/camera.h"
#include "tools/doctor/checks.h"

namespace nanomap::doctor {

inline Time atMs(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

/// Adds what was heard, `count` times `period_ms` apart, each `lag_ms` after its stamp.
inline void hear(Heard& heard, InputKind kind, const std::string& channel, const std::string& type, int count,
                 int period_ms, int lag_ms) {
  constexpr int kStart_ms = 1'000;
  HeardStream& stream = heard.streams[static_cast<std::size_t>(kind)];
  for (int i = 0; i < count; ++i) {
    const Time stamp = atMs(kStart_ms + i * period_ms);
    stream.sightings.push_back({stamp, stamp + std::chrono::milliseconds(lag_ms)});
    if (kind != InputKind::kPose) continue;
    BodyPose pose;
    pose.stamp = stamp;
    heard.poses.push_back(pose);
  }
  stream.messages = static_cast<std::uint64_t>(count);
  heard.channels.push_back({channel, type, stream.messages});
}

/// A second of a vehicle that is healthy: live, on the monotonic clock, camera described by itself.
inline Facts healthyFacts() {
  Facts facts;
  Heard& heard = facts.heard.emplace();
  heard.duration = std::chrono::seconds(1);
  heard.realtime_ahead = std::chrono::seconds(1'700'000'000);
  hear(heard, InputKind::kPose, "POSE_BODY", "nanomap.body_pose_t", 100, 10, 5);
  hear(heard, InputKind::kDepth, "DEPTH", "nanomap.depth_image_t", 30, 33, 30);
  heard.streams[static_cast<std::size_t>(InputKind::kCamera)].messages = 1;
  heard.channels.push_back({"CAMERA", "nanomap.camera_model_t", 1});
  heard.camera = CameraInput{"front", test::smallCamera()};
  return facts;
}

/// The gravest of them.
inline Verdict verdictOf(const Findings& findings) {
  Verdict gravest = Verdict::kOk;
  for (const Finding& finding : findings) {
    if (finding.verdict == Verdict::kNotLookedAt && gravest == Verdict::kOk) gravest = finding.verdict;
    if (finding.verdict == Verdict::kWarning && gravest != Verdict::kFailure) gravest = finding.verdict;
    if (finding.verdict == Verdict::kFailure) gravest = finding.verdict;
  }
  return gravest;
}

/// All that is said to do.
inline std::string fixesOf(const Findings& findings) {
  std::string fixes;
  for (const Finding& finding : findings) fixes += finding.fix + "\n";
  return fixes;
}

}  // namespace nanomap::doctor
