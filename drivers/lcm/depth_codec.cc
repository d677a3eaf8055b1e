#include "drivers/lcm/depth_codec.h"

#include <blosc.h>

#include <bit>
#include <stdexcept>

namespace nanomap {
namespace {

static_assert(std::endian::native == std::endian::little, "logs hold little-endian pixels");

/// The fastest level: higher ones take four times as long for a few percent.
constexpr int kLevel = 1;
constexpr const char* kCompressor = BLOSC_ZSTD_COMPNAME;
constexpr std::size_t kPixelBytes = sizeof(std::uint16_t);
constexpr std::size_t kAutomaticBlockSize = 0;
constexpr int kThreads = 1;

}  // namespace

std::vector<std::uint8_t> compressDepth(std::span<const std::uint16_t> pixels) {
  std::vector<std::uint8_t> compressed(pixels.size_bytes() + BLOSC_MAX_OVERHEAD);
  const int size = blosc_compress_ctx(kLevel, BLOSC_SHUFFLE, kPixelBytes, pixels.size_bytes(), pixels.data(),
                                      compressed.data(), compressed.size(), kCompressor, kAutomaticBlockSize, kThreads);
  if (size <= 0) throw std::runtime_error("Blosc could not compress a depth image (code " + std::to_string(size) + ")");
  compressed.resize(static_cast<std::size_t>(size));
  return compressed;
}

std::optional<std::size_t> compressedPixelCount(Bytes compressed) {
  std::size_t size = 0;
  if (blosc_cbuffer_validate(compressed.data(), compressed.size(), &size) != 0) return std::nullopt;
  std::size_t type_size = 0;
  int flags = 0;
  blosc_cbuffer_metainfo(compressed.data(), &type_size, &flags);
  if (type_size != kPixelBytes || size % kPixelBytes != 0) return std::nullopt;
  return size / kPixelBytes;
}

bool decompressDepth(Bytes compressed, std::span<std::uint16_t> pixels) {
  if (compressedPixelCount(compressed) != pixels.size()) return false;
  if (pixels.empty()) return true;
  const int size = blosc_decompress_ctx(compressed.data(), pixels.data(), pixels.size_bytes(), kThreads);
  return size >= 0 && static_cast<std::size_t>(size) == pixels.size_bytes();
}

}  // namespace nanomap
