#pragma once

#include <system_error>

namespace nanomap {

/// Whether this build locks memory: sanitizers reserve terabytes of addresses, which cannot be locked.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kLocksMemory = false;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kLocksMemory = false;
#else
inline constexpr bool kLocksMemory = true;
#endif
#else
inline constexpr bool kLocksMemory = true;
#endif

/// Keeps every page of the process, present and future, in memory, and freed memory with the process: neither using
/// memory for the first time nor allocating what was freed costs a page fault. What is new still does, at its
/// allocation. To be called once, at start-up, before threads are made. Does nothing unless kLocksMemory.
/// @return the kernel's refusal, which judgeRealtime() explains; no error if all is well
[[nodiscard]] std::error_code lockMemory();

}  // namespace nanomap
