#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <variant>
#include <vector>

#include "core/camera_model.h"
#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/lcm/encode.h"
#include "drivers/lcm/message_types.h"
#include "tests/fuzz/require.h"

namespace nanomap::fuzz {
namespace {

template <class Value>
void checkImage(const Converted<Value>& converted) {
  if (const auto* image = std::get_if<Value>(&converted)) {
    require(image->pixels.size() ==
            static_cast<std::size_t>(image->width_px) * static_cast<std::size_t>(image->height_px));
  }
}

/// Types that say nothing of core's.
template <class Message>
void convert(const Message&) {}

void convert(const body_pose_t& message) {
  static_cast<void>(toBodyPose(message));
  static_cast<void>(toBodyMotion(message));
}

void convert(const bot_core::pose_t& message) {
  static_cast<void>(toBodyPose(message, BodyConvention::kFlu, 0));
  static_cast<void>(toBodyPose(message, BodyConvention::kFrd, 0));
}

void convert(const pose_correction_t& message) { static_cast<void>(toCorrection(message)); }
void convert(const goal_t& message) { static_cast<void>(toGoal(message)); }
void convert(const transform_t& message) { static_cast<void>(toPose(message)); }
void convert(const depth_image_t& message) { checkImage(toDepthImage(message)); }
void convert(const bot_core::images_t& message) { checkImage(toDepthImage(message, 0)); }
void convert(const bot_core::image_t& message) { checkImage(toDepthImage(message, 0)); }

void convert(const camera_model_t& message) {
  const auto parameters = toCameraParameters(message);
  if (!std::holds_alternative<CameraParameters>(parameters)) return;
  try {
    static_cast<void>(CameraModel(std::get<CameraParameters>(parameters)));
  } catch (const std::invalid_argument&) {  // it says which of them cannot be
  }
}

/// What decodes must take as many bytes when it is encoded again, and survive its conversion.
template <class Message>
void decodeAndConvert(Bytes bytes) {
  const Decoded<Message> decoded = decode<Message>(bytes);
  const auto* message = std::get_if<Message>(&decoded);
  if (!message) return;
  std::vector<std::uint8_t> encoded;
  require(encodeInto(*message, encoded) && encoded.size() == bytes.size());
  convert(*message);
}

using Check = void (*)(Bytes);
struct Type {
  std::int64_t hash;
  Check check;
};

const std::vector<Type>& types() {
#define NANOMAP_TYPE(Message) {Message::getHash(), decodeAndConvert<Message>},
  static const std::vector<Type> all = {NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_TYPE)};
#undef NANOMAP_TYPE
  return all;
}

}  // namespace
}  // namespace nanomap::fuzz

/// The bytes are a message. One of an unknown type is taken for one of a type that its hash selects.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  const std::optional<std::int64_t> hash = messageHash({data, size});
  if (!hash) return 0;
  for (const fuzz::Type& type : fuzz::types()) {
    if (type.hash != *hash) continue;
    type.check({data, size});
    return 0;
  }
  const fuzz::Type& type = fuzz::types()[static_cast<std::uint64_t>(*hash) % fuzz::types().size()];
  std::vector<std::uint8_t> message(data, data + size);
  for (std::size_t i = 0; i < sizeof(type.hash); ++i) {
    message[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(type.hash) >> (56 - 8 * i));
  }
  type.check(message);
  return 0;
}
