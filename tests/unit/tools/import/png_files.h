#pragma once

#include <lodepng.h>

#include <cstdint>
#include <string>
#include <vector>

namespace nanomap {

/// Encoded PNG with the given samples as they are in the file: 16-bit ones big-endian.
inline std::string encodePng(const std::vector<unsigned char>& samples, unsigned width, unsigned height,
                             LodePNGColorType type, unsigned bits) {
  lodepng::State state;
  state.info_raw.colortype = type;
  state.info_raw.bitdepth = bits;
  state.info_png.color.colortype = type;
  state.info_png.color.bitdepth = bits;
  state.encoder.auto_convert = 0;
  std::vector<unsigned char> bytes;
  lodepng::encode(bytes, samples, width, height, state);
  return {bytes.begin(), bytes.end()};
}

/// A 16-bit grey PNG.
inline std::string encodeDepthPng(const std::vector<std::uint16_t>& pixels, unsigned width, unsigned height) {
  std::vector<unsigned char> samples;
  for (const std::uint16_t pixel : pixels) {
    samples.push_back(static_cast<unsigned char>(pixel >> 8U));
    samples.push_back(static_cast<unsigned char>(pixel & 0xFFU));
  }
  return encodePng(samples, width, height, LCT_GREY, 16);
}

}  // namespace nanomap
