#include <cstddef>
#include <cstdint>
#include <vector>

#include "drivers/lcm/depth_codec.h"
#include "tests/fuzz/require.h"

/// The bytes are a compressed image: whatever they decompress to must survive the way through the codec.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  constexpr std::size_t kMostPixels = 1 << 20;  // more only takes longer
  const Bytes compressed(data, size);
  const auto count = compressedPixelCount(compressed);
  if (!count || *count > kMostPixels) return 0;
  std::vector<std::uint16_t> pixels(*count);
  if (!decompressDepth(compressed, pixels)) return 0;
  std::vector<std::uint16_t> again(*count);
  fuzz::require(decompressDepth(compressDepth(pixels), again) && again == pixels);
  return 0;
}
