#include "tools/sim/message_faults.h"

#include <algorithm>
#include <array>
#include <limits>
#include <stdexcept>
#include <utility>
#include <variant>

#include "drivers/lcm/decode.h"
#include "drivers/lcm/encode.h"
#include "nanomap/body_pose_t.hpp"
#include "nanomap/goal_t.hpp"
#include "nanomap/pose_correction_t.hpp"

namespace nanomap::sim {
namespace {

constexpr double kCorrectionJump_m = 5.0;

// A burst is as much as a subscription of liblcm's could hold, and more than anyone sends by mistake.
constexpr int kBurstMessages = 40;
constexpr std::size_t kBurstBytes = 1200;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The message, changed by `change`; as it is, if it is of another type.
template <class Message, class Change>
Bytes changed(Bytes bytes, std::vector<std::uint8_t>& encoded, Change&& change) {
  auto decoded = decode<Message>(bytes);
  auto* const message = std::get_if<Message>(&decoded);
  if (message == nullptr) return bytes;
  change(*message);
  return encodeInto(*message, encoded) ? Bytes(encoded) : bytes;
}

}  // namespace

std::string_view toString(MessageFault fault) {
  switch (fault) {
    case MessageFault::kCameraFrozen:
      return "camera-frozen";
    case MessageFault::kCameraLate:
      return "camera-late";
    case MessageFault::kCameraFlickers:
      return "camera-flickers";
    case MessageFault::kCameraGarbage:
      return "camera-garbage";
    case MessageFault::kPosesLate:
      return "poses-late";
    case MessageFault::kPosesNotANumber:
      return "poses-nan";
    case MessageFault::kPosesGarbage:
      return "poses-garbage";
    case MessageFault::kCorrectionsJump:
      return "corrections-jump";
    case MessageFault::kCorrectionsGarbage:
      return "corrections-garbage";
    case MessageFault::kGoalNonsense:
      return "goal-nonsense";
    case MessageFault::kFlood:
      return "flood";
  }
  return "?";
}

std::string namesOfMessageFaults() {
  std::string names;
  for (std::size_t i = 0; i < kMessageFaultCount; ++i) {
    names += (i > 0 ? ", " : "") + std::string(toString(static_cast<MessageFault>(i)));
  }
  return names;
}

PlannedMessageFault parseMessageFault(std::string_view option, std::string_view text) {
  const std::string_view name = text.substr(0, text.find(':'));
  for (std::size_t i = 0; i < kMessageFaultCount; ++i) {
    const auto fault = static_cast<MessageFault>(i);
    if (name == toString(fault) && name.size() < text.size()) {
      return {fault, parseOutage(option, text.substr(name.size() + 1))};
    }
  }
  throw std::invalid_argument(std::string(option) + " " + std::string(text) +
                              ": give a fault, seconds after the departure and seconds, as in camera-frozen:5:1; the "
                              "faults are " +
                              namesOfMessageFaults());
}

MessageFaults::MessageFaults(const LcmParameters& channels, std::vector<PlannedMessageFault> plan)
    : channels_(channels), plan_(std::move(plan)) {}

void MessageFaults::pass(const std::string& channel, Time arrival, Bytes message,
                         std::optional<Duration> since_departure, const Send& send) {
  since_departure_ = since_departure;
  for (; !late_.empty() && late_.front().due <= arrival; late_.pop_front()) {
    send(late_.front().channel, late_.front().message);
  }
  if (isOn(MessageFault::kFlood) && channel == channels_.pose_channel) flood(send);
  if (const auto passed = befallen(channel, arrival, message)) send(channel, *passed);
}

bool MessageFaults::isOn(MessageFault fault) const {
  return since_departure_ && std::ranges::any_of(plan_, [&](const PlannedMessageFault& planned) {
           return planned.fault == fault && planned.when.holds(*since_departure_);
         });
}

std::optional<Bytes> MessageFaults::befallen(const std::string& channel, Time arrival, Bytes message) {
  const bool camera = channel == channels_.depth_channel;
  const bool pose = channel == channels_.pose_channel;
  const bool correction = channel == channels_.correction_channel;
  const auto on = [this](bool of_this_channel, MessageFault fault) { return of_this_channel && isOn(fault); };

  if (on(camera, MessageFault::kCameraLate) || on(pose, MessageFault::kPosesLate)) {
    late_.push_back({arrival + kLateness, channel, {message.begin(), message.end()}});
    return std::nullopt;
  }
  if (on(camera, MessageFault::kCameraFlickers) && *since_departure_ / kFlicker % 2 == 0) return std::nullopt;
  if (on(camera, MessageFault::kCameraGarbage) || on(pose, MessageFault::kPosesGarbage) ||
      on(correction, MessageFault::kCorrectionsGarbage)) {
    return garbage(message.size());
  }
  if (on(camera, MessageFault::kCameraFrozen)) return frozen(message);
  if (on(pose, MessageFault::kPosesNotANumber)) {
    return changed<body_pose_t>(message, encoded_,
                                [](body_pose_t& m) { m.world_from_body.translation[0] = kNotANumber; });
  }
  if (on(correction, MessageFault::kCorrectionsJump)) {
    odd_ = !odd_;
    return changed<pose_correction_t>(message, encoded_, [this](pose_correction_t& m) {
      for (auto& each : m.poses) each.transform.translation[1] += odd_ ? kCorrectionJump_m : 0.0;
    });
  }
  if (on(channel == channels_.goal_channel, MessageFault::kGoalNonsense)) {
    odd_ = !odd_;
    return changed<goal_t>(message, encoded_, [this](goal_t& m) {
      m.position[0] = odd_ ? kNotANumber : kInfinity;
      m.top_speed = odd_ ? kInfinity : kNotANumber;
    });
  }
  return message;
}

Bytes MessageFaults::frozen(Bytes message) {
  return changed<depth_image_t>(message, encoded_, [this](depth_image_t& m) {
    if (!picture_) picture_ = m;
    depth_image_t again = *picture_;
    again.utime = m.utime;
    again.sequence = m.sequence;
    m = std::move(again);
  });
}

Bytes MessageFaults::garbage(std::size_t size) {
  encoded_.resize(size);
  std::ranges::generate(encoded_, [this] { return static_cast<std::uint8_t>(random_()); });
  return encoded_;
}

void MessageFaults::flood(const Send& send) {
  const std::array<const std::string*, 5> channels = {&channels_.depth_channel, &channels_.pose_channel,
                                                      &channels_.correction_channel, &channels_.camera_channel,
                                                      &channels_.goal_channel};
  for (int i = 0; i < kBurstMessages; ++i) {
    send(*channels[static_cast<std::size_t>(i) % channels.size()], garbage(kBurstBytes));
  }
}

}  // namespace nanomap::sim
