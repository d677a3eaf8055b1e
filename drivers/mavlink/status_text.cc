#include "drivers/mavlink/status_text.h"

#include <algorithm>

namespace nanomap {

std::vector<StatusTextChunk> statusTextChunks(Severity severity, std::string_view text, std::uint16_t id) {
  constexpr std::size_t kChunkLength = 50;
  // The last chunk is the one that is not full.
  std::string ascii(text.substr(0, kMaxStatusTextChunks * kChunkLength - 1));
  std::ranges::replace_if(
      ascii, [](char c) { return c < ' ' || c > '~'; }, '?');
  if (ascii.size() <= kChunkLength) return {{severity, 0, 0, ascii}};
  std::vector<StatusTextChunk> chunks;
  for (std::size_t start = 0; start <= ascii.size(); start += kChunkLength) {
    chunks.push_back({severity, std::max<std::uint16_t>(id, 1), static_cast<std::uint8_t>(chunks.size()),
                      ascii.substr(start, kChunkLength)});
  }
  return chunks;
}

}  // namespace nanomap
