#pragma once

#include <cstdint>

namespace nanomap {

// A program that is linked with this has its global operators new and delete replaced by ones that count.

/// Times that the calling thread has called operator new since it started.
[[nodiscard]] std::uint64_t allocationsOfThisThread() noexcept;

}  // namespace nanomap
