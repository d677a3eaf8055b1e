#pragma once

#include <cstdlib>

namespace nanomap::fuzz {

/// Ends the program, and so makes the input a finding, unless the condition holds.
inline void require(bool condition) {
  if (!condition) std::abort();
}

}  // namespace nanomap::fuzz
