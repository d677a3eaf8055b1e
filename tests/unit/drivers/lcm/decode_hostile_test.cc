#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "drivers/lcm/decode.h"
#include "tests/support/allocations.h"
#include "tests/unit/drivers/example_log.h"
#include "tests/unit/drivers/message_types_list.h"

namespace nanomap {
namespace {

using Encoded = std::vector<std::uint8_t>;

/// Empty metadata takes 9 bytes encoded and 64 in memory; nothing grows more.
constexpr std::size_t kGrowth = 8;

/// Decodes what may be anything. It must neither crash, throw nor allocate more than a multiple of the bytes; what it
/// accepts must be a message: encoded again, it takes as many bytes.
template <class Message>
void survive(const Encoded& bytes) {
  const std::size_t before = test::allocatedBytes();
  const Decoded<Message> decoded = decode<Message>(bytes);
  const std::size_t allocated = test::allocatedBytes() - before;
  RC_ASSERT(allocated <= kGrowth * bytes.size());
  if (const auto* message = std::get_if<Message>(&decoded)) {
    RC_ASSERT(static_cast<std::size_t>(message->getEncodedSize()) == bytes.size());
  }
}

void putHash(Encoded& bytes, std::int64_t hash) {
  for (std::size_t i = 0; i < 8 && i < bytes.size(); ++i) {
    bytes[i] = static_cast<std::uint8_t>(static_cast<std::uint64_t>(hash) >> (56 - 8 * i));
  }
}

template <class Message>
class DecodeHostile : public ::testing::Test {};
TYPED_TEST_SUITE(DecodeHostile, AllMessageTypes, MessageTypeName);

TYPED_TEST(DecodeHostile, RandomBytesBehindTheHashAreSurvived) {
  EXPECT_TRUE(rc::check("random bytes", [] {
    auto bytes = *rc::gen::arbitrary<Encoded>();
    putHash(bytes, TypeParam::getHash());
    survive<TypeParam>(bytes);
  }));
}

TYPED_TEST(DecodeHostile, DamagedMessagesAreSurvived) {
  const std::vector<Encoded> examples = exampleMessages(TypeParam::getTypeName());
  ASSERT_FALSE(examples.empty());
  EXPECT_TRUE(rc::check("damaged messages", [&] {
    Encoded bytes = *rc::gen::elementOf(examples);
    const auto damages = *rc::gen::inRange(1, 8);
    for (int i = 0; i < damages; ++i) {
      // Small values and sign bits are what turns one length into another.
      const auto value = *rc::gen::oneOf(rc::gen::arbitrary<std::uint8_t>(),
                                         rc::gen::element<std::uint8_t>(0x00, 0x01, 0x7F, 0x80, 0xFF));
      bytes[*rc::gen::inRange<std::size_t>(8, bytes.size())] = value;
    }
    const auto cut = *rc::gen::inRange<std::size_t>(0, 4);
    bytes.resize(bytes.size() - std::min(cut, bytes.size()));
    survive<TypeParam>(bytes);
  }));
}

}  // namespace
}  // namespace nanomap
