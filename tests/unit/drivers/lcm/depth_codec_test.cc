#include "drivers/lcm/depth_codec.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <random>

namespace nanomap {
namespace {

using Pixels = std::vector<std::uint16_t>;

Pixels noise(std::size_t count) {
  std::mt19937 random(1);
  Pixels pixels(count);
  for (std::uint16_t& pixel : pixels) pixel = static_cast<std::uint16_t>(random());
  return pixels;
}

Pixels slope(std::size_t count) {
  Pixels pixels(count);
  for (std::size_t i = 0; i < count; ++i) pixels[i] = static_cast<std::uint16_t>(1000 + i % 848);
  return pixels;
}

void expectRoundTrip(const Pixels& pixels) {
  const std::vector<std::uint8_t> compressed = compressDepth(pixels);
  EXPECT_EQ(compressedPixelCount(compressed), pixels.size());
  Pixels back(pixels.size(), 12345);
  ASSERT_TRUE(decompressDepth(compressed, back));
  EXPECT_EQ(back, pixels);
}

TEST(DepthCodec, DrawnImagesComeBack) {
  constexpr std::size_t kCount = 848 * 480;
  expectRoundTrip(Pixels());
  expectRoundTrip({0});
  expectRoundTrip({65535});
  expectRoundTrip(Pixels(kCount, 0));
  expectRoundTrip(Pixels(kCount, 65535));
  expectRoundTrip(slope(kCount));
  expectRoundTrip(noise(kCount));
}

RC_GTEST_PROP(DepthCodec, AnyImageComesBack, (const Pixels& pixels)) {
  Pixels back(pixels.size());
  RC_ASSERT(decompressDepth(compressDepth(pixels), back));
  RC_ASSERT(back == pixels);
}

TEST(DepthCodec, SmoothDepthShrinksAndNoiseHardlyGrows) {
  EXPECT_LT(compressDepth(slope(848 * 480)).size(), 848U * 480U * 2U / 4U);
  EXPECT_LE(compressDepth(noise(848 * 480)).size(), 848U * 480U * 2U + 16U);
}

TEST(DepthCodec, SamePixelsGiveSameBytes) { EXPECT_EQ(compressDepth(slope(10'000)), compressDepth(slope(10'000))); }

TEST(DepthCodec, OtherSizeIsRefused) {
  const std::vector<std::uint8_t> compressed = compressDepth(slope(100));
  for (const std::size_t size : {0U, 99U, 101U}) {
    Pixels back(size);
    EXPECT_FALSE(decompressDepth(compressed, back)) << size;
  }
}

TEST(DepthCodec, BytesThatAreNoChunkAreRefused) {
  EXPECT_EQ(compressedPixelCount({}), std::nullopt);
  EXPECT_EQ(compressedPixelCount(std::vector<std::uint8_t>(100, 0)), std::nullopt);
  std::vector<std::uint8_t> cut = compressDepth(slope(100));
  cut.pop_back();
  EXPECT_EQ(compressedPixelCount(cut), std::nullopt);
}

TEST(DepthCodec, ChunkOfOtherTypeIsRefused) {
  std::vector<std::uint8_t> compressed = compressDepth(slope(100));
  compressed[3] = 4;  // Blosc's type size
  EXPECT_EQ(compressedPixelCount(compressed), std::nullopt);
}

RC_GTEST_PROP(DepthCodec, DamagedBytesAreSurvived, ()) {
  static const std::vector<std::uint8_t> smooth = compressDepth(slope(2000));
  static const std::vector<std::uint8_t> noisy = compressDepth(noise(2000));
  std::vector<std::uint8_t> bytes = *rc::gen::element(smooth, noisy);
  const auto damages = *rc::gen::inRange(1, 6);
  for (int i = 0; i < damages; ++i) {
    const auto at =
        *rc::gen::oneOf(rc::gen::inRange<std::size_t>(0, 32), rc::gen::inRange<std::size_t>(0, bytes.size()));
    bytes[at] = *rc::gen::arbitrary<std::uint8_t>();
  }
  Pixels back(2000);
  RC_CLASSIFY(decompressDepth(bytes, back), "still decodes");
}

}  // namespace
}  // namespace nanomap
