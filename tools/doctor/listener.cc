#include "tools/doctor/listener.h"

#include <algorithm>
#include <utility>
#include <variant>

#include "drivers/lcm/decode.h"
#include "drivers/lcm/message_types.h"
#include "firmware_app/pipeline/stamp_clock.h"

namespace nanomap::doctor {
namespace {

constexpr Duration kFrameSpacing = std::chrono::milliseconds(200);
constexpr Duration kBurst = std::chrono::seconds(3);
constexpr int kBursts = 12;  // 12 x 15 frames of 640x480 are 110 MB

/// As "nanomap.body_pose_t"; empty if it is none of lcm_types.
std::string typeOf(Bytes message) {
  const auto hash = messageHash(message);
  std::string type;
#define NANOMAP_NAME_TYPE(Type) \
  if (hash == Type::getHash()) type = #Type;
  NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_NAME_TYPE)
#undef NANOMAP_NAME_TYPE
  if (const std::size_t colons = type.find("::"); colons != std::string::npos) type.replace(colons, 2, ".");
  return type;
}

}  // namespace

FrameSampling::FrameSampling(Time start, Duration length)
    : start_(start), period_(std::max<Duration>(length / kBursts, kBurst)) {}

bool FrameSampling::wants(Time arrival) {
  const bool in_burst = (arrival - start_) % period_ < kBurst;
  if (!in_burst || (kept_ && arrival - *kept_ < kFrameSpacing)) return false;
  kept_ = arrival;
  return true;
}

Listener::Listener(const LcmParameters& lcm, Time start, Duration length)
    : health_channel_(lcm.health_channel), intake_(lcm), sampling_(start, length) {
  heard_.duration = length;
}

void Listener::take(const ReceivedMessage& message, Time arrival) {
  auto channel = channels_.find(message.channel);
  if (channel == channels_.end()) {
    const std::string name(message.channel);
    channel = channels_.emplace(name, HeardChannel{name, typeOf(message.bytes)}).first;
  }
  ++channel->second.messages;
  if (const auto kind = intake_.kindOf(message.channel)) takeInput(*kind, message, arrival);
  if (message.channel == health_channel_) {
    const auto decoded = decode<health_t>(message.bytes);
    if (const auto* health = std::get_if<health_t>(&decoded))
      heard_.health = HeardHealth{health->state, health->reason};
  }
}

void Listener::takeInput(InputKind kind, const ReceivedMessage& message, Time arrival) {
  HeardStream& stream = heard_.streams[static_cast<std::size_t>(kind)];
  auto outcome = intake_.read(kind, message.bytes);
  if (auto* input = std::get_if<Input>(&outcome)) {
    ++stream.messages;
    if (const auto stamp = stampOf(*input)) stream.sightings.push_back({*stamp, arrival});
    keep(kind, std::move(*input), arrival);
    return;
  }
  ++stream.unreadable;
  if (const auto* fault = std::get_if<DecodeFault>(&outcome)) stream.fault = toString(*fault);
  if (const auto* fault = std::get_if<ConvertFault>(&outcome)) stream.fault = toString(*fault);
}

void Listener::keep(InputKind kind, Input input, Time arrival) {
  if (kind == InputKind::kPose) heard_.poses.push_back(std::get<PoseInput>(input).pose);
  if (kind == InputKind::kDepth && sampling_.wants(arrival)) {
    heard_.frames.push_back(std::get<DepthInput>(std::move(input)));
  }
  if (kind == InputKind::kCamera && !heard_.camera) heard_.camera = std::get<CameraInput>(std::move(input));
}

Heard Listener::finish() && {
  for (auto& [name, channel] : channels_) heard_.channels.push_back(std::move(channel));
  return std::move(heard_);
}

}  // namespace nanomap::doctor
