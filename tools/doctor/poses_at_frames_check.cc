#include <fmt/format.h>

#include <array>

#include "tools/doctor/checks.h"
#include "tools/doctor/frame_pairs.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "poses of frames";

/// Frames so near to the beginning or the end of the poses may be without one: a part of the stream was not heard.
constexpr Duration kEdge = std::chrono::milliseconds(500);

}  // namespace

Findings checkPosesAtFrames(const Facts& facts) {
  constexpr double kMost = 0.9;
  const auto& frames = facts.heard->stream(InputKind::kDepth).sightings;
  if (facts.heard->poses.empty() || frames.empty()) {
    return {notLookedAt(kSubject, "there are no poses, or no frames")};
  }
  const PoseBuffer poses = poseBufferOf(*facts.heard, facts.configuration.chain.max_pose_gap);
  if (poses.empty()) {
    return {failure(kSubject, fmt::format("none of {} poses is a pose", facts.heard->poses.size()),
                    "send finite positions and unit quaternions (w, x, y, z)")};
  }
  std::array<std::uint64_t, 5> counts{};
  std::uint64_t asked = 0;
  for (const Sighting& frame : frames) {
    if (frame.stamp < poses.oldest().stamp && frame.stamp > poses.oldest().stamp - kEdge) continue;
    if (frame.stamp > poses.newest().stamp && frame.stamp < poses.newest().stamp + kEdge) continue;
    ++asked;
    ++counts[static_cast<std::size_t>(poses.interpolate(frame.stamp).status)];
  }
  const auto count = [&](PoseBuffer::LookupStatus status) { return counts[static_cast<std::size_t>(status)]; };
  const std::uint64_t found = count(PoseBuffer::LookupStatus::kFound);
  if (asked == 0) return {notLookedAt(kSubject, "no frame lies within the time of the poses")};
  const std::string seen = fmt::format(
      "{} of {} frames have a pose at their stamp; {} older than the poses, {} newer, {} in a gap, {} in a jump", found,
      asked, count(PoseBuffer::LookupStatus::kBeforeOldest), count(PoseBuffer::LookupStatus::kAfterNewest),
      count(PoseBuffer::LookupStatus::kGap), count(PoseBuffer::LookupStatus::kBetweenEpochs));
  if (found == asked) return {ok(kSubject, fmt::format("all {} frames have a pose at their stamp", asked))};
  const std::string fix = "poses have to span every frame's stamp, with no gap above history.max_pose_gap_s";
  const bool most = static_cast<double>(found) >= kMost * static_cast<double>(asked);
  return {most ? warning(kSubject, seen, fix) : failure(kSubject, seen, fix)};
}

}  // namespace nanomap::doctor
