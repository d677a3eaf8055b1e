#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "rates";

struct Intervals {
  Duration median{};
  Duration longest{};
  std::uint64_t over = 0;        ///< longer than allowed
  std::uint64_t disordered = 0;  ///< stamps that were not newer than the one before
};

/// Between the stamps of messages that follow each other. Empty of fewer than two.
std::optional<Intervals> intervalsOf(const HeardStream& stream, Duration allowed) {
  if (stream.sightings.size() < 2) return std::nullopt;
  Intervals intervals;
  std::vector<Duration> all;
  for (std::size_t i = 1; i < stream.sightings.size(); ++i) {
    const Duration interval = stream.sightings[i].stamp - stream.sightings[i - 1].stamp;
    if (interval <= Duration::zero()) ++intervals.disordered;
    if (interval > allowed) ++intervals.over;
    all.push_back(interval);
  }
  std::ranges::sort(all);
  intervals.median = all[all.size() / 2];
  intervals.longest = all.back();
  return intervals;
}

Finding judge(InputKind kind, const Intervals& intervals, Duration allowed, const std::string& key,
              const std::string& consequence) {
  const std::string seen =
      fmt::format("{} come every {:.1f} ms by their stamps (median), the longest gap is {:.0f} ms", toString(kind),
                  toSeconds(intervals.median) * 1e3, toSeconds(intervals.longest) * 1e3);
  if (intervals.median > allowed || intervals.median <= Duration::zero()) {
    return failure(kSubject, fmt::format("{}; {} allows {:g} s", seen, key, toSeconds(allowed)),
                   intervals.median > allowed ? "send them more often: " + consequence
                                              : "stamp each message with its own time: most do not move on");
  }
  if (intervals.disordered > 0) {
    return warning(kSubject, fmt::format("{}; {} are not newer than the one before", seen, intervals.disordered),
                   "find who sends twice, or late; two senders on one channel look like this");
  }
  if (intervals.over > 0) {
    return warning(
        kSubject, fmt::format("{}; {} gaps are longer than {} = {:g} s", seen, intervals.over, key, toSeconds(allowed)),
        "find what holds the sender up, or what loses messages: " + consequence);
  }
  return ok(kSubject, seen);
}

}  // namespace

Findings checkRates(const Facts& facts) {
  const Configuration& configuration = facts.configuration;
  const Duration pose_gap = configuration.chain.max_pose_gap;
  const Duration depth_gap = configuration.safety.max_depth_age;
  const auto poses = intervalsOf(facts.heard->stream(InputKind::kPose), pose_gap);
  const auto depth = intervalsOf(facts.heard->stream(InputKind::kDepth), depth_gap);
  Findings findings;
  if (poses) {
    findings.push_back(judge(InputKind::kPose, *poses, pose_gap, "history.max_pose_gap_s",
                             "frames between poses that are farther apart are dropped"));
  }
  if (depth) {
    findings.push_back(judge(InputKind::kDepth, *depth, depth_gap, "safety.max_depth_age_s",
                             "it brakes when the newest frame is older"));
  }
  if (poses && depth && poses->median > Duration::zero()) {
    const double history_s = toSeconds(depth->median) * static_cast<double>(configuration.chain.history_views);
    const double kept_s = toSeconds(poses->median) * static_cast<double>(configuration.chain.pose_capacity);
    if (kept_s < history_s) {
      findings.push_back(warning(
          kSubject,
          fmt::format("history.pose_capacity holds {:.1f} s of poses, history.views {:.1f} s", kept_s, history_s),
          fmt::format("history.pose_capacity = {:.0f}", 2.0 * history_s / toSeconds(poses->median))));
    }
  }
  if (findings.empty()) findings.push_back(notLookedAt(kSubject, "too little was heard"));
  return findings;
}

}  // namespace nanomap::doctor
