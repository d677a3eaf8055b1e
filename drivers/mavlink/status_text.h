#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace nanomap {

/// MAV_SEVERITY.
enum class Severity : std::uint8_t {
  kEmergency = 0,
  kAlert = 1,
  kCritical = 2,
  kError = 3,
  kWarning = 4,
  kNotice = 5,
  kInfo = 6,
  kDebug = 7,
};

/// One STATUSTEXT message. Chunks of one text share an `id` that is not 0.
struct StatusTextChunk {
  Severity severity = Severity::kInfo;
  std::uint16_t id = 0;
  std::uint8_t chunk_seq = 0;
  std::string text;

  bool operator==(const StatusTextChunk&) const = default;
};

inline constexpr std::size_t kMaxStatusTextChunks = 4;

/// A text as messages of 50 characters at most: one for most texts, never more than kMaxStatusTextChunks; what is
/// longer is cut. Ground stations show ASCII: any other byte becomes '?'.
/// @param id  tells the chunks of this text from those of the one before; 0 counts as 1
[[nodiscard]] std::vector<StatusTextChunk> statusTextChunks(Severity severity, std::string_view text, std::uint16_t id);

}  // namespace nanomap
