#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <zlib.h>

#include <limits>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "drivers/lcm/depth_codec.h"
#include "tests/unit/drivers/example_log.h"

namespace nanomap {
namespace {

using Pixels = std::vector<std::uint16_t>;

DepthImage image() {
  DepthImage depth;
  depth.stamp = Time(std::chrono::milliseconds(1500));
  depth.sequence = 4;
  depth.width_px = 3;
  depth.height_px = 2;
  depth.depth_unit_m = 0.0001;
  depth.pixels = {1, 2, 3, 400, 500, 65535};
  return depth;
}

/// As python_log.py draws it.
Pixels pythonPixels() {
  Pixels pixels;
  for (int i = 0; i < 12; ++i) pixels.push_back(static_cast<std::uint16_t>(i * 5461));
  return pixels;
}

std::vector<std::uint8_t> littleEndian(const Pixels& pixels) {
  std::vector<std::uint8_t> bytes;
  for (const std::uint16_t pixel : pixels) {
    bytes.push_back(static_cast<std::uint8_t>(pixel & 0xFF));
    bytes.push_back(static_cast<std::uint8_t>(pixel >> 8));
  }
  return bytes;
}

std::vector<std::uint8_t> zipped(const std::vector<std::uint8_t>& plain) {
  std::vector<std::uint8_t> bytes(compressBound(plain.size()));
  uLongf size = bytes.size();
  EXPECT_EQ(compress(bytes.data(), &size, plain.data(), plain.size()), Z_OK);
  bytes.resize(size);
  return bytes;
}

void setData(bot_core::image_t& target, std::vector<std::uint8_t> data) {
  target.size = static_cast<std::int32_t>(data.size());
  target.data = std::move(data);
}

bot_core::image_t greyImage(const std::vector<std::uint8_t>& data) {
  bot_core::image_t message{};
  message.utime = 1'500'000;
  message.width = 3;
  message.height = 2;
  message.row_stride = 6;
  message.pixelformat = bot_core::image_t::PIXEL_FORMAT_LE_GRAY16;
  setData(message, data);
  return message;
}

bot_core::images_t imagesOf(std::int16_t type, const bot_core::image_t& depth) {
  bot_core::images_t message{};
  message.utime = 1'600'000;
  message.n_images = 1;
  message.image_types = {type};
  message.images = {depth};
  return message;
}

template <class Message, class... Arguments>
ConvertFault faultOf(const Message& message, Arguments... arguments) {
  return std::get<ConvertFault>(toDepthImage(message, arguments...));
}

class DepthImageMessage : public ::testing::TestWithParam<DepthCompression> {};

TEST_P(DepthImageMessage, GivesTheImageBack) {
  const DepthImage sent = image();
  const depth_image_t message = toMessage(sent, "front", GetParam());
  EXPECT_EQ(message.camera, "front");
  EXPECT_EQ(message.size, static_cast<std::int32_t>(message.data.size()));
  const auto back = std::get<DepthImage>(toDepthImage(message));
  EXPECT_EQ(back.stamp, sent.stamp);
  EXPECT_EQ(back.sequence, sent.sequence);
  EXPECT_EQ(back.width_px, sent.width_px);
  EXPECT_EQ(back.height_px, sent.height_px);
  EXPECT_EQ(back.depth_unit_m, sent.depth_unit_m);
  EXPECT_EQ(back.pixels, sent.pixels);
}

TEST_P(DepthImageMessage, ImageWithoutPixelsPassesThrough) {
  const auto back = std::get<DepthImage>(toDepthImage(toMessage(DepthImage{}, "", GetParam())));
  EXPECT_TRUE(back.pixels.empty());
}

TEST_P(DepthImageMessage, HeaderFaultsAreNamed) {
  depth_image_t message = toMessage(image(), "", GetParam());
  message.width = 4;
  EXPECT_EQ(faultOf(message), ConvertFault::kSizeMismatch);
  message.width = -3;
  EXPECT_EQ(faultOf(message), ConvertFault::kBadSize);
  message.width = message.height = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(faultOf(message), ConvertFault::kBadSize);
  message.utime = -1;
  EXPECT_EQ(faultOf(message), ConvertFault::kBadStamp);
  message.sequence = -1;
  EXPECT_EQ(faultOf(message), ConvertFault::kBadSequence);
}

INSTANTIATE_TEST_SUITE_P(Both, DepthImageMessage, ::testing::Values(DepthCompression::kRaw, DepthCompression::kBlosc),
                         [](const auto& param) { return param.param == DepthCompression::kRaw ? "Raw" : "Blosc"; });

TEST(DepthImageMessage, DataFaultsAreNamed) {
  depth_image_t message = toMessage(image(), "", DepthCompression::kRaw);
  message.data.pop_back();
  EXPECT_EQ(faultOf(message), ConvertFault::kSizeMismatch);
  message.compression = depth_image_t::BLOSC;
  EXPECT_EQ(faultOf(message), ConvertFault::kBadCompressedData);
  message.compression = 2;
  EXPECT_EQ(faultOf(message), ConvertFault::kUnknownCompression);
  message.compression = -1;
  EXPECT_EQ(faultOf(message), ConvertFault::kUnknownCompression);
}

TEST(DepthImageMessage, PythonsBloscIsRead) {
  const auto bytes = exampleMessages("RECOGNISABLE_DEPTH");
  ASSERT_EQ(bytes.size(), 1U);
  const auto depth = std::get<DepthImage>(toDepthImage(std::get<depth_image_t>(decode<depth_image_t>(bytes.front()))));
  EXPECT_EQ(depth.stamp, Time(std::chrono::seconds(2)));
  EXPECT_EQ(depth.sequence, 8U);
  EXPECT_EQ(depth.width_px, 4);
  EXPECT_EQ(depth.height_px, 3);
  EXPECT_EQ(depth.depth_unit_m, 0.0001);
  EXPECT_EQ(depth.pixels, pythonPixels());
}

TEST(BotCoreImages, PythonsDepthIsReadRawAndZipped) {
  for (const char* channel : {"RECOGNISABLE_IMAGES", "RECOGNISABLE_IMAGES_ZIPPED"}) {
    const auto bytes = exampleMessages(channel);
    ASSERT_EQ(bytes.size(), 1U);
    const auto message = std::get<bot_core::images_t>(decode<bot_core::images_t>(bytes.front()));
    const auto depth = std::get<DepthImage>(toDepthImage(message, 11));
    EXPECT_EQ(depth.stamp, Time(std::chrono::seconds(3))) << "the message's stamp";
    EXPECT_EQ(depth.sequence, 11U);
    EXPECT_EQ(depth.depth_unit_m, 0.001);
    EXPECT_EQ(depth.pixels, pythonPixels()) << channel;
  }
}

TEST(BotCoreImages, WithoutDepthIsNamed) {
  EXPECT_EQ(faultOf(bot_core::images_t{}, 0U), ConvertFault::kNoDepthImage);
  const bot_core::image_t grey = greyImage(littleEndian(image().pixels));
  EXPECT_EQ(faultOf(imagesOf(bot_core::images_t::DISPARITY, grey), 0U), ConvertFault::kNoDepthImage);
  bot_core::images_t without_image = imagesOf(bot_core::images_t::DEPTH_MM, grey);
  without_image.images.clear();
  EXPECT_EQ(faultOf(without_image, 0U), ConvertFault::kNoDepthImage);
}

TEST(BotCoreImages, ZippedFaultsAreNamed) {
  constexpr auto kType = bot_core::images_t::DEPTH_MM_ZIPPED;
  const std::vector<std::uint8_t> stream = zipped(littleEndian(image().pixels));
  bot_core::image_t depth = greyImage(stream);
  EXPECT_EQ(std::get<DepthImage>(toDepthImage(imagesOf(kType, depth), 0)).pixels, image().pixels);

  setData(depth, {stream.begin(), stream.end() - 3});
  EXPECT_EQ(faultOf(imagesOf(kType, depth), 0U), ConvertFault::kBadCompressedData);
  setData(depth, {});
  EXPECT_EQ(faultOf(imagesOf(kType, depth), 0U), ConvertFault::kBadCompressedData);
  setData(depth, zipped(littleEndian({1, 2, 3})));
  EXPECT_EQ(faultOf(imagesOf(kType, depth), 0U), ConvertFault::kSizeMismatch);
  setData(depth, zipped(std::vector<std::uint8_t>(100'000, 0)));
  EXPECT_EQ(faultOf(imagesOf(kType, depth), 0U), ConvertFault::kBadCompressedData) << "more than announced";
}

TEST(BotCoreImages, SizeBeyondWhatTheStreamCanHoldIsRefusedUnread) {
  bot_core::image_t depth = greyImage(zipped(littleEndian(image().pixels)));
  depth.width = 2000;
  depth.height = 2000;
  depth.row_stride = 4000;
  EXPECT_EQ(faultOf(imagesOf(bot_core::images_t::DEPTH_MM_ZIPPED, depth), 0U), ConvertFault::kSizeMismatch);
  depth.row_stride = std::numeric_limits<std::int32_t>::max();
  EXPECT_EQ(faultOf(imagesOf(bot_core::images_t::DEPTH_MM_ZIPPED, depth), 0U), ConvertFault::kBadSize);
}

TEST(BotCoreImage, BothByteOrdersAreRead) {
  bot_core::image_t message = greyImage(littleEndian(image().pixels));
  const auto little = std::get<DepthImage>(toDepthImage(message, 5));
  EXPECT_EQ(little.pixels, image().pixels);
  EXPECT_EQ(little.stamp, Time(std::chrono::milliseconds(1500)));
  for (std::size_t i = 0; i < message.data.size(); i += 2) std::swap(message.data[i], message.data[i + 1]);
  message.pixelformat = bot_core::image_t::PIXEL_FORMAT_BE_GRAY16;
  EXPECT_EQ(std::get<DepthImage>(toDepthImage(message, 5)).pixels, image().pixels);
}

TEST(BotCoreImage, RowPaddingIsLeftOut) {
  bot_core::image_t message = greyImage(littleEndian({1, 2, 3, 77, 400, 500, 65535, 77}));
  message.row_stride = 8;
  EXPECT_EQ(std::get<DepthImage>(toDepthImage(message, 0)).pixels, image().pixels);
}

TEST(BotCoreImage, FaultsAreNamed) {
  bot_core::image_t message = greyImage(littleEndian(image().pixels));
  for (const std::int32_t stride : {-6, 0, 5, 7}) {
    message.row_stride = stride;
    EXPECT_EQ(faultOf(message, 0U), ConvertFault::kSizeMismatch) << stride;
  }
  message = greyImage(littleEndian(image().pixels));
  message.height = -1;
  EXPECT_EQ(faultOf(message, 0U), ConvertFault::kBadSize);
  message.utime = std::numeric_limits<std::int64_t>::max();
  EXPECT_EQ(faultOf(message, 0U), ConvertFault::kBadStamp);
  message.pixelformat = bot_core::image_t::PIXEL_FORMAT_RGB;
  EXPECT_EQ(faultOf(message, 0U), ConvertFault::kUnknownPixelFormat);
}

RC_GTEST_PROP(BotCoreImages, AnyHeaderAndDataAreSurvived, ()) {
  const auto small = rc::gen::inRange<std::int32_t>(-2, 20);
  bot_core::image_t depth{};
  depth.width = *rc::gen::oneOf(small, rc::gen::arbitrary<std::int32_t>());
  depth.height = *rc::gen::oneOf(small, rc::gen::arbitrary<std::int32_t>());
  depth.row_stride = *rc::gen::oneOf(small, rc::gen::arbitrary<std::int32_t>());
  depth.pixelformat = bot_core::image_t::PIXEL_FORMAT_LE_GRAY16;
  setData(depth, *rc::gen::arbitrary<std::vector<std::uint8_t>>());
  const auto type = *rc::gen::element(bot_core::images_t::DEPTH_MM + 0, bot_core::images_t::DEPTH_MM_ZIPPED + 0);
  const Converted<DepthImage> in_set = toDepthImage(imagesOf(static_cast<std::int16_t>(type), depth), 0);
  const Converted<DepthImage> alone = toDepthImage(depth, 0);
  for (const auto* converted : {&in_set, &alone}) {
    if (const auto* read = std::get_if<DepthImage>(converted)) {
      RC_ASSERT(read->pixels.size() ==
                static_cast<std::size_t>(read->width_px) * static_cast<std::size_t>(read->height_px));
    }
  }
}

}  // namespace
}  // namespace nanomap
