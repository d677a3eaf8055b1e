#pragma once

#include <cstddef>

namespace nanomap::test {

// Linking this replaces the global operators new and delete of the program.

/// Times that the process has called operator new so far.
[[nodiscard]] std::size_t allocationCount();

/// Bytes that it has asked for.
[[nodiscard]] std::size_t allocatedBytes();

}  // namespace nanomap::test
