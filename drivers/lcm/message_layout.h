#pragma once

#include <optional>

#include "drivers/lcm/byte_cursor.h"
#include "drivers/lcm/decode.h"

namespace nanomap {

/// What is wrong with the encoded fields of a message (the bytes behind its hash), judged by the lengths in them alone.
/// Defined for every type of lcm_types.
template <class Message>
[[nodiscard]] std::optional<DecodeFault> checkLayout(Bytes fields);

}  // namespace nanomap
