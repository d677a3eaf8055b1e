#include "drivers/lcm/decode.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <map>
#include <set>
#include <string>

#include "tests/unit/drivers/example_log.h"
#include "tests/unit/drivers/message_types_list.h"

namespace nanomap {
namespace {

using Encoded = std::vector<std::uint8_t>;

template <class Message>
Encoded encoded(const Message& message) {
  Encoded bytes(static_cast<std::size_t>(message.getEncodedSize()));
  EXPECT_EQ(message.encode(bytes.data(), 0, static_cast<int>(bytes.size())), static_cast<int>(bytes.size()));
  return bytes;
}

template <class Message>
std::optional<DecodeFault> faultOf(Bytes bytes) {
  const Decoded<Message> decoded = decode<Message>(bytes);
  const auto* fault = std::get_if<DecodeFault>(&decoded);
  return fault ? std::optional(*fault) : std::nullopt;
}

TEST(MessageHash, EqualsPublicDefinitions) {
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::pose_t::getHash()), 0x2e16efb052b0105eU);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::image_t::getHash()), 0x14739ffe13d5f5f0U);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::images_t::getHash()), 0x20ba4f05e8f5e33aU);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::planar_lidar_t::getHash()), 0xe3d17423180b5e8dU);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::rigid_transform_t::getHash()), 0xea9ffbf2acc5c5aeU);
  EXPECT_EQ(static_cast<std::uint64_t>(bot_core::utime_t::getHash()), 0x4d0d41c1f105b12fU);
}

TEST(MessageHash, TooFewBytesHaveNone) {
  EXPECT_EQ(messageHash({}), std::nullopt);
  EXPECT_EQ(messageHash(Encoded(7, 1)), std::nullopt);
  EXPECT_EQ(messageHash(Encoded(8, 0xFF)), -1);
}

TEST(DecodeFault, EveryOneHasItsWords) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i < kDecodeFaultCount; ++i) words.insert(toString(static_cast<DecodeFault>(i)));
  EXPECT_EQ(words.size(), kDecodeFaultCount);
  EXPECT_FALSE(words.contains("?"));
}

template <class Message>
class DecodeEveryType : public ::testing::Test {
 protected:
  std::vector<Encoded> examples = exampleMessages(Message::getTypeName());
};
TYPED_TEST_SUITE(DecodeEveryType, AllMessageTypes, MessageTypeName);

TYPED_TEST(DecodeEveryType, PythonEncodingComesBackUnchanged) {
  ASSERT_EQ(this->examples.size(), 3U);
  for (const Encoded& example : this->examples) {
    EXPECT_EQ(messageHash(example), TypeParam::getHash());
    const Decoded<TypeParam> decoded = decode<TypeParam>(example);
    ASSERT_TRUE(std::holds_alternative<TypeParam>(decoded)) << toString(std::get<DecodeFault>(decoded));
    EXPECT_EQ(encoded(std::get<TypeParam>(decoded)), example);
  }
}

TYPED_TEST(DecodeEveryType, EveryShorterMessageIsTruncated) {
  for (const Encoded& example : this->examples) {
    for (std::size_t size = 0; size < example.size(); ++size) {
      EXPECT_EQ(faultOf<TypeParam>(Bytes(example).first(size)), DecodeFault::kTruncated) << size << " bytes";
    }
  }
}

TYPED_TEST(DecodeEveryType, OneMoreByteTrails) {
  for (Encoded example : this->examples) {
    example.push_back(0);
    EXPECT_EQ(faultOf<TypeParam>(example), DecodeFault::kTrailingBytes);
  }
}

TYPED_TEST(DecodeEveryType, AnotherHashIsAnotherType) {
  Encoded example = this->examples.back();
  example[7] ^= 1;
  EXPECT_EQ(faultOf<TypeParam>(example), DecodeFault::kWrongType);
}

/// A camera model whose name and list are as given, to be damaged at known places.
Encoded cameraModel(const std::string& name) {
  camera_model_t camera{};
  camera.name = name;
  camera.num_no_return_values = 2;
  camera.no_return_values = {0, 65535};
  return encoded(camera);
}

constexpr std::size_t kNameLengthAt = 16;  // behind hash and utime

void storeInt32(Encoded& bytes, std::size_t at, std::int32_t value) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[at + i] = static_cast<std::uint8_t>(static_cast<std::uint32_t>(value) >> (24 - 8 * i));
  }
}

TEST(Decode, StringLengthOfZeroIsBad) {
  Encoded bytes = cameraModel("x");
  storeInt32(bytes, kNameLengthAt, 0);
  EXPECT_EQ(faultOf<camera_model_t>(bytes), DecodeFault::kBadLength);
}

TEST(Decode, StringWithoutTerminatorIsBad) {
  Encoded bytes = cameraModel("x");
  bytes[kNameLengthAt + 5] = 'y';
  EXPECT_EQ(faultOf<camera_model_t>(bytes), DecodeFault::kBadLength);
}

TEST(Decode, StringWithAnEarlierTerminatorIsBad) {
  Encoded bytes = cameraModel("xyz");
  bytes[kNameLengthAt + 5] = 0;
  EXPECT_EQ(faultOf<camera_model_t>(bytes), DecodeFault::kBadLength);
}

TEST(Decode, NegativeLengthIsBad) {
  Encoded bytes = cameraModel("x");
  for (const std::int32_t length : {-1, std::numeric_limits<std::int32_t>::min()}) {
    storeInt32(bytes, kNameLengthAt, length);
    EXPECT_EQ(faultOf<camera_model_t>(bytes), DecodeFault::kBadLength);
  }
}

TEST(Decode, HugeLengthIsTruncated) {
  Encoded bytes = cameraModel("x");
  storeInt32(bytes, bytes.size() - 12, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(faultOf<camera_model_t>(bytes), DecodeFault::kTruncated);
}

TEST(Decode, HugeNumberOfImagesIsTruncated) {
  Encoded bytes = encoded(bot_core::images_t{});
  storeInt32(bytes, 16, std::numeric_limits<std::int32_t>::max());
  EXPECT_EQ(faultOf<bot_core::images_t>(bytes), DecodeFault::kTruncated);
}

}  // namespace
}  // namespace nanomap
