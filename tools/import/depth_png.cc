#include "tools/import/depth_png.h"

#include <fmt/format.h>
#include <lodepng.h>

#include <stdexcept>
#include <string>

namespace nanomap {
namespace {

/// Far above any depth camera; a damaged header must not ask for gigabytes.
constexpr unsigned kMaxSide_px = 8192;

std::string describe(const LodePNGColorMode& color) {
  switch (color.colortype) {
    case LCT_GREY:
      return fmt::format("{}-bit grey", color.bitdepth);
    case LCT_GREY_ALPHA:
      return fmt::format("{}-bit grey with alpha", color.bitdepth);
    case LCT_PALETTE:
      return "a palette";
    default:
      return fmt::format("{}-bit colour", color.bitdepth);
  }
}

}  // namespace

DepthPng readDepthPng(const std::filesystem::path& file) {
  const std::string name = file.string();
  const auto fail = [&name](const std::string& what) { throw std::runtime_error(name + ": " + what); };

  std::vector<unsigned char> bytes;
  if (lodepng::load_file(bytes, name) != 0) fail("cannot be read");

  lodepng::State state;
  unsigned width = 0;
  unsigned height = 0;
  if (const unsigned error = lodepng_inspect(&width, &height, &state, bytes.data(), bytes.size()); error != 0) {
    fail(fmt::format("not a PNG: {}", lodepng_error_text(error)));
  }
  const LodePNGColorMode& color = state.info_png.color;
  if (color.colortype != LCT_GREY || color.bitdepth != 16) {
    fail(fmt::format("{}, but depth is read from 16-bit grey", describe(color)));
  }
  if (width > kMaxSide_px || height > kMaxSide_px) {
    fail(fmt::format("{}x{} px is more than {} a side", width, height, kMaxSide_px));
  }

  std::vector<unsigned char> samples;
  if (const unsigned error = lodepng::decode(samples, width, height, bytes, LCT_GREY, 16); error != 0) {
    fail(fmt::format("damaged PNG: {}", lodepng_error_text(error)));
  }
  DepthPng image{static_cast<int>(width), static_cast<int>(height), {}};
  image.pixels.reserve(samples.size() / 2);
  for (std::size_t i = 0; i + 1 < samples.size(); i += 2) {  // PNG is big-endian
    image.pixels.push_back(static_cast<std::uint16_t>(samples[i] << 8U | samples[i + 1]));
  }
  return image;
}

}  // namespace nanomap
