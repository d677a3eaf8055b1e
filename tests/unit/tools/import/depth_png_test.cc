#include "tools/import/depth_png.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "png_files.h"
#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

class DepthPngTest : public testing::Test {
 protected:
  void expectFault(const std::string& content, const std::string& fault) {
    const auto file = folder_.write("bad.png", content);
    EXPECT_THAT([&] { (void)readDepthPng(file); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr("bad.png"), HasSubstr(fault))));
  }
  TemporaryFolder folder_;
};

TEST_F(DepthPngTest, ReadsCountsRowByRow) {
  const auto file = folder_.write("a.png", encodeDepthPng({0, 1, 255, 256, 4660, 65535}, 3, 2));
  const DepthPng image = readDepthPng(file);
  EXPECT_EQ(image.width_px, 3);
  EXPECT_EQ(image.height_px, 2);
  EXPECT_THAT(image.pixels, ElementsAre(0, 1, 255, 256, 4660, 65535));
}

TEST_F(DepthPngTest, ReadsSinglePixel) {
  EXPECT_THAT(readDepthPng(folder_.write("a.png", encodeDepthPng({1234}, 1, 1))).pixels, ElementsAre(1234));
}

TEST_F(DepthPngTest, NamesOtherPixelFormats) {
  expectFault(encodePng({1, 2, 3, 4}, 2, 2, LCT_GREY, 8), "8-bit grey, but depth is read from 16-bit grey");
  expectFault(encodePng(std::vector<unsigned char>(12, 9), 2, 2, LCT_RGB, 8), "8-bit colour");
  expectFault(encodePng(std::vector<unsigned char>(16, 9), 2, 2, LCT_GREY_ALPHA, 16), "16-bit grey with alpha");
}

TEST_F(DepthPngTest, NamesWhatIsNoPng) {
  expectFault("", "not a PNG");
  expectFault("P5 2 2 65535 this is another format of images", "not a PNG");
}

TEST_F(DepthPngTest, NamesTruncatedAndDamagedFiles) {
  std::vector<std::uint16_t> pixels(64 * 48);
  for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] = static_cast<std::uint16_t>(i * 7919);
  const std::string whole = encodeDepthPng(pixels, 64, 48);
  expectFault(whole.substr(0, whole.size() / 2), "damaged PNG");
  std::string flipped = whole;
  flipped[flipped.size() / 2] = static_cast<char>(~flipped[flipped.size() / 2]);
  expectFault(flipped, "damaged PNG");
}

TEST_F(DepthPngTest, RefusesAbsurdSizeBeforeAllocating) {
  constexpr std::size_t kWidthInHeader = 16;
  std::string huge = encodeDepthPng({1}, 1, 1);
  huge.replace(kWidthInHeader, 8, std::string("\x00\x01\x00\x00\x00\x01\x00\x00", 8));
  const unsigned crc = lodepng_crc32(reinterpret_cast<const unsigned char*>(huge.data()) + 12, 17);
  for (unsigned i = 0; i < 4; ++i) huge[29 + i] = static_cast<char>(crc >> (24U - 8U * i) & 0xFFU);
  expectFault(huge, "65536x65536 px is more than");
}

TEST_F(DepthPngTest, NamesMissingFile) {
  EXPECT_THAT([&] { (void)readDepthPng(folder_.path() / "absent.png"); },
              ThrowsMessage<std::runtime_error>(HasSubstr("absent.png: cannot be read")));
}

}  // namespace
}  // namespace nanomap
