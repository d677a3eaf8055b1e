#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace nanomap {

/// Raw depth counts of one 16-bit grey PNG, row-major.
struct DepthPng {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint16_t> pixels;
};

/// @throws std::runtime_error naming the file and what is wrong: unreadable, damaged, or not 16-bit grey
[[nodiscard]] DepthPng readDepthPng(const std::filesystem::path& file);

}  // namespace nanomap
