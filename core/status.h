#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace nanomap {

/// What a view knows about an uncertain point. Absence of data is a status, never a number and never silently free.
enum class Status : std::uint8_t {
  kFree,         ///< the box is inside the view and the mean is in front of what was seen
  kPartial,      ///< the mean is, the box is not
  kOpen,         ///< no depth at the pixel, and nothing near around it at its level or above: sky
  kHole,         ///< no depth at the pixel otherwise: glass, texture, too near
  kOccluded,     ///< behind what was seen
  kBeyondRange,  ///< inside the sides of the view, farther than the sensor is trusted
  kOutsideFov,   ///< outside the sides of the view
  kBehind,       ///< behind the near plane
  kEmpty,        ///< no view yet
};
inline constexpr std::size_t kStatusCount = 9;

[[nodiscard]] std::string_view toString(Status status);

}  // namespace nanomap
