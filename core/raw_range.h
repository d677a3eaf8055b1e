#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nanomap {

/// The raw values that are returns in a camera's trusted range: `least` .. `greatest` without the `excluded` ones in
/// between. None at all if `least` is above `greatest`.
struct RawRange {
  std::uint16_t least = 1;
  std::uint16_t greatest = 0;
  std::vector<std::uint16_t> excluded;  ///< values that mean "no depth" although they lie in between: rare

  [[nodiscard]] bool empty() const { return least > greatest; }
  [[nodiscard]] bool contains(std::uint16_t raw) const {
    return raw >= least && raw <= greatest && std::find(excluded.begin(), excluded.end(), raw) == excluded.end();
  }
};

}  // namespace nanomap
