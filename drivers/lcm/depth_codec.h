#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/lcm/byte_cursor.h"

namespace nanomap {

/// Most pixels that an image from outside may announce: four times a 1920x1080 sensor, 16 MB. What is larger is damage.
inline constexpr std::size_t kMaxImagePixels = 8'294'400;

/// A size that an image from outside may announce: not negative, and of no more pixels.
[[nodiscard]] constexpr bool isImageSize(std::int32_t width_px, std::int32_t height_px) {
  return width_px >= 0 && height_px >= 0 &&
         static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px) <= kMaxImagePixels;
}

/// Lossless compression of a 16-bit depth image: one Blosc 1 chunk, bytes shuffled (the high bytes of neighbouring
/// depths are alike), then Zstandard. The same pixels give the same bytes, whatever the environment.
/// @pre at most kMaxImagePixels
/// @throws std::runtime_error if Blosc fails (it cannot, but for memory)
/// Allocates. Threads: a function of its arguments; starts none.
[[nodiscard]] std::vector<std::uint8_t> compressDepth(std::span<const std::uint16_t> pixels);

/// Pixels that the compressed bytes announce; empty if they cannot be one chunk of 16-bit values. Call it before
/// allocating. Allocates: no.
[[nodiscard]] std::optional<std::size_t> compressedPixelCount(Bytes compressed);

/// Undoes compressDepth() on bytes that nobody vouches for. False if they are not a chunk of exactly `pixels.size()`
/// pixels, or are damaged; `pixels` is then unspecified.
[[nodiscard]] bool decompressDepth(Bytes compressed, std::span<std::uint16_t> pixels);

}  // namespace nanomap
