#include "drivers/mavlink/parameter_value.h"

#include <bit>
#include <cmath>
#include <cstdint>

namespace nanomap {
namespace {

// MAV_PARAM_TYPE
constexpr std::uint8_t kUint8 = 1;
constexpr std::uint8_t kInt32 = 6;
constexpr std::uint8_t kReal32 = 9;

}  // namespace

std::optional<double> numberOf(const ParameterMessage& message, AutopilotKind kind) {
  if (message.type == kInt32 && kind == AutopilotKind::kPx4) return std::bit_cast<std::int32_t>(message.value);
  const bool plain = message.type == kReal32 || (message.type >= kUint8 && message.type <= kInt32);
  if (!plain || !std::isfinite(message.value)) return std::nullopt;
  return static_cast<double>(message.value);
}

}  // namespace nanomap
