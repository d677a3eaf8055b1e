#pragma once

#include <cstddef>

namespace nanomap {

/// Bytes that the process has asked of operator new so far. Linking this replaces the global operators.
[[nodiscard]] std::size_t allocatedBytes();

}  // namespace nanomap
