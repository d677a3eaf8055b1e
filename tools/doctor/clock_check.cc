#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "clock";

/// Farther off than this, stamps are of another clock altogether.
constexpr Duration kSameClock = std::chrono::minutes(1);

/// No machine has been up for so long, and no clock of the day is set to so early (September 2001).
constexpr Duration kTimeOfDay = std::chrono::seconds(1'000'000'000);

/// From stamp to arrival.
struct Lag {
  Duration least{};
  Duration median{};
  Duration most{};
};

std::optional<Lag> lagOf(const HeardStream& stream) {
  if (stream.sightings.empty()) return std::nullopt;
  std::vector<Duration> lags;
  for (const Sighting& sighting : stream.sightings) lags.push_back(sighting.arrival - sighting.stamp);
  std::ranges::sort(lags);
  return Lag{lags.front(), lags[lags.size() / 2], lags.back()};
}

std::string_view nameOf(ClockDomain clock) {
  switch (clock) {
    case ClockDomain::kMonotonic:
      return "monotonic";
    case ClockDomain::kRealtime:
      return "realtime";
    case ClockDomain::kLog:
      break;
  }
  return "log";
}

bool isNear(Duration lag) { return std::chrono::abs(lag) < kSameClock; }

/// What is received live, of one stream. @param lag  by CLOCK_MONOTONIC
Finding judgeLive(const Facts& facts, InputKind kind, const Lag& lag, Duration max_age) {
  const ClockDomain configured = facts.configuration.lcm.clock;
  const bool wants_realtime = configured == ClockDomain::kRealtime;
  const Duration to_realtime = facts.heard->realtime_ahead;
  const Duration off = lag.median + (wants_realtime ? to_realtime : Duration::zero());
  const Duration off_other = lag.median + (wants_realtime ? Duration::zero() : to_realtime);
  const ClockDomain other = wants_realtime ? ClockDomain::kMonotonic : ClockDomain::kRealtime;
  if (!isNear(off)) {
    const std::string seen = fmt::format("stamps of {} are {:.3g} s from this machine's {} clock, lcm.clock",
                                         toString(kind), std::abs(toSeconds(off)), nameOf(configured));
    if (isNear(off_other)) {
      return failure(kSubject, fmt::format("{}, and of its {} clock", seen, nameOf(other)),
                     fmt::format("lcm.clock = \"{}\"", nameOf(other)));
    }
    return failure(kSubject, seen + ", and of no other clock of this machine",
                   "stamp with a clock of this machine, or keep the sender's in step with it (chrony, PTP) and set "
                   "lcm.clock = \"realtime\"; a log that is played can only be tried: lcm.clock = \"log\"");
  }
  const Duration shift = off - lag.median;
  const double age_s = toSeconds(off);
  const double least_s = toSeconds(lag.least + shift);
  if (lag.least + shift < -facts.configuration.safety.max_stamp_lead) {
    return failure(kSubject, fmt::format("{} are up to {:.3f} s ahead of our clock", toString(kind), -least_s),
                   "they are stamped by another clock, or with a constant added: keep the clocks in step, or take the "
                   "constant out where they are stamped");
  }
  if (off > max_age) {
    return failure(kSubject,
                   fmt::format("{} are {:.3f} s old when they come (median); at most {:g} s is flown with",
                               toString(kind), age_s, toSeconds(max_age)),
                   "find what holds them up, or what shifts their stamps; they are to be those of the exposure");
  }
  return ok(kSubject, fmt::format("{} are {:.1f} ms old when they come (median; {:.1f} .. {:.1f}), by the {} clock",
                                  toString(kind), age_s * 1e3, least_s * 1e3, toSeconds(lag.most + shift) * 1e3,
                                  nameOf(configured)));
}

/// What a log tells of the clock that stamps are of: by how large they are, since it holds no other clock.
Finding judgeLogDomain(const Facts& facts, const HeardStream& poses) {
  const ClockDomain configured = facts.configuration.lcm.clock;
  const Duration stamp = poses.sightings.front().stamp.time_since_epoch();
  const ClockDomain said = stamp >= kTimeOfDay ? ClockDomain::kRealtime : ClockDomain::kMonotonic;
  const std::string seen = fmt::format("stamps begin at {:.3f} s, which is {}", toSeconds(stamp),
                                       said == ClockDomain::kRealtime ? "a time of day" : "a time since boot");
  if (configured == ClockDomain::kLog || configured == said) return ok(kSubject, seen);
  return warning(
      kSubject,
      fmt::format("{}; lcm.clock is \"{}\": a replay does not mind, a flight would", seen, nameOf(configured)),
      fmt::format("lcm.clock = \"{}\", if the vehicle stamps like this log", nameOf(said)));
}

/// Both streams are late by about the same, whatever the clock that arrivals are of.
std::optional<Finding> judgeBetween(const Facts& facts, const Lag& poses, const Lag& depth) {
  constexpr Duration kEarliest = std::chrono::milliseconds(-50);  // a pose computed by a slow estimator
  const Duration between = depth.median - poses.median;
  if (between >= kEarliest && between <= facts.configuration.safety.max_depth_age) return std::nullopt;
  return failure(
      kSubject,
      fmt::format("depth frames are stamped {:.3f} s {} than poses that come at the same moment",
                  std::abs(toSeconds(between)), between > Duration::zero() ? "earlier" : "later"),
      fmt::format("stamp both by one clock, frames at their exposure: add {:.3f} s to the stamps of depth frames where "
                  "they are sent",
                  toSeconds(between)));
}

}  // namespace

Findings checkClock(const Facts& facts) {
  const Heard& heard = *facts.heard;
  const auto poses = lagOf(heard.stream(InputKind::kPose));
  const auto depth = lagOf(heard.stream(InputKind::kDepth));
  Findings findings;
  if (heard.from_log) {
    if (poses) findings.push_back(judgeLogDomain(facts, heard.stream(InputKind::kPose)));
  } else if (facts.configuration.lcm.clock != ClockDomain::kLog) {
    const SafetyParameters& safety = facts.configuration.safety;
    if (poses) findings.push_back(judgeLive(facts, InputKind::kPose, *poses, safety.max_pose_age));
    if (depth) findings.push_back(judgeLive(facts, InputKind::kDepth, *depth, safety.max_depth_age));
  }
  if (poses && depth && !anyFailure(findings)) {
    if (auto finding = judgeBetween(facts, *poses, *depth)) findings.push_back(std::move(*finding));
  }
  if (findings.empty()) findings.push_back(notLookedAt(kSubject, "nothing with a stamp was heard"));
  return findings;
}

}  // namespace nanomap::doctor
