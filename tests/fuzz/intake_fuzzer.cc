#include <cstddef>
#include <cstdint>
#include <variant>

#include "drivers/lcm/byte_cursor.h"
#include "firmware_app/pipeline/chain_stage.h"
#include "firmware_app/pipeline/message_intake.h"
#include "firmware_app/pipeline/stamp_clock.h"

namespace nanomap::fuzz {
namespace {

ChainParameters smallChain() {
  ChainParameters parameters;
  parameters.history_views = 4;
  parameters.pose_capacity = 16;
  return parameters;
}

void take(ChainStage& chain, const Input& input) {
  if (const auto* pose = std::get_if<PoseInput>(&input)) {
    chain.take(*pose);
  } else if (const auto* correction = std::get_if<Correction>(&input)) {
    chain.take(*correction);
  } else if (const auto* goal = std::get_if<Goal>(&input)) {
    chain.take(*goal);
  }
}

}  // namespace
}  // namespace nanomap::fuzz

/// The bytes are messages one after the other, each behind its kind (one byte) and its size (two, big-endian). All are
/// read as they would arrive and moved to another clock; poses, corrections and goals reach a chain.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  MessageIntake intake{LcmParameters{}};
  ChainStage chain(fuzz::smallChain());
  ByteCursor cursor({data, size});
  while (cursor.remaining() > 0) {
    const auto kind = static_cast<InputKind>(static_cast<std::uint8_t>(cursor.read<std::int8_t>()) % kInputKindCount);
    const auto bytes = static_cast<std::uint16_t>(cursor.read<std::int16_t>());
    const Bytes message = cursor.take(bytes);
    auto outcome = intake.read(kind, message);
    auto* input = std::get_if<Input>(&outcome);
    if (!input) continue;
    shiftStamps(*input, Duration(bytes));
    static_cast<void>(stampOf(*input));
    fuzz::take(chain, *input);
  }
  static_cast<void>(chain.chain().snapshot());
  return 0;
}
