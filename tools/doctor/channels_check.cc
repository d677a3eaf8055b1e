#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "channels";

struct Wanted {
  InputKind kind;
  std::string_view key;
  std::vector<std::string_view> types;
  bool required;
  std::string_view without;  ///< what happens, if it is not required
};

std::array<Wanted, kInputKindCount> wantedOf(const Facts& facts) {
  return {{{InputKind::kPose, "lcm.pose_channel", {"nanomap.body_pose_t", "bot_core.pose_t"}, true, {}},
           {InputKind::kCorrection,
            "lcm.correction_channel",
            {"nanomap.pose_correction_t"},
            false,
            "the past stays as it was estimated"},
           {InputKind::kCamera,
            "lcm.camera_channel",
            {"nanomap.camera_model_t"},
            !facts.configuration.camera,
            "[camera] says what it is"},
           {InputKind::kDepth,
            "lcm.depth_channel",
            {"nanomap.depth_image_t", "bot_core.images_t", "bot_core.image_t"},
            true,
            {}},
           {InputKind::kGoal, "lcm.goal_channel", {"nanomap.goal_t"}, false, "it hovers until one comes"}}};
}

/// Channels that nothing is configured for, and whose type would do.
std::vector<std::string> candidates(const Facts& facts, const Wanted& wanted) {
  std::vector<std::string> names;
  for (const HeardChannel& channel : facts.heard->channels) {
    const bool fits = std::ranges::find(wanted.types, channel.type) != wanted.types.end();
    bool taken = false;
    for (std::size_t i = 0; i < kInputKindCount; ++i) {
      taken = taken || channel.name == channelOf(facts.configuration.lcm, static_cast<InputKind>(i));
    }
    if (fits && !taken) names.push_back(channel.name);
  }
  return names;
}

Finding silence(const Facts& facts, const Wanted& wanted) {
  const LcmParameters& lcm = facts.configuration.lcm;
  const std::string& name = channelOf(lcm, wanted.kind);
  const std::string seen =
      fmt::format("no {} on '{}' in {:.1f} s", toString(wanted.kind), name, toSeconds(facts.heard->duration));
  const std::vector<std::string> others = candidates(facts, wanted);
  if (!others.empty()) {
    std::string also = fmt::format("{}, but there are messages of their type on {}", seen, fmt::join(others, ", "));
    std::string fix = fmt::format("{} = \"{}\"", wanted.key, fmt::join(others, "\", or \""));
    return wanted.required ? failure(kSubject, std::move(also), std::move(fix)) : ok(kSubject, std::move(also));
  }
  if (!wanted.required) return ok(kSubject, fmt::format("{}: {}", seen, wanted.without));
  if (facts.heard->from_log) return failure(kSubject, seen, "record that channel, or set " + std::string(wanted.key));
  return failure(kSubject, seen, fmt::format("start what sends it, or set {}", wanted.key));
}

Finding judge(const Facts& facts, const Wanted& wanted) {
  const HeardStream& stream = facts.heard->stream(wanted.kind);
  const std::string& name = channelOf(facts.configuration.lcm, wanted.kind);
  const HeardChannel* channel = facts.heard->channel(name);
  if (!channel) return silence(facts, wanted);
  const std::string type = channel->type.empty() ? "a type that is none of lcm_types" : channel->type;
  if (stream.unreadable > 0) {
    const std::string seen = fmt::format("{} of {} messages on '{}' ({}) cannot be read as {}: {}", stream.unreadable,
                                         channel->messages, name, type, toString(wanted.kind), stream.fault);
    const std::string fix = fmt::format("send {}, or set {}", fmt::join(wanted.types, " or "), wanted.key);
    return stream.messages == 0 ? failure(kSubject, seen, fix) : warning(kSubject, seen, fix);
  }
  return ok(kSubject, fmt::format("{} {} on '{}' ({})", stream.messages, toString(wanted.kind), name, type));
}

}  // namespace

Findings checkChannels(const Facts& facts) {
  if (facts.heard->channels.empty()) {
    return {failure(kSubject, fmt::format("nothing at all was heard in {:.1f} s", toSeconds(facts.heard->duration)),
                    "start what sends poses and depth, with the same group and port as lcm.url; between two machines "
                    "both ends need ttl=1")};
  }
  Findings findings;
  for (const Wanted& wanted : wantedOf(facts)) findings.push_back(judge(facts, wanted));
  return findings;
}

}  // namespace nanomap::doctor
