#pragma once

#include <cstddef>

namespace nanomap {

/// Memory for a thread's stack, every page of it there from the start, above a page that may not be touched: running
/// over the end is a fault, not damage. Allocates: at construction, from the kernel.
class ThreadStack {
 public:
  /// @param bytes  rounded up to whole pages
  /// @throws std::system_error if there is not that much memory
  explicit ThreadStack(std::size_t bytes);
  ~ThreadStack();
  ThreadStack(const ThreadStack&) = delete;
  ThreadStack& operator=(const ThreadStack&) = delete;

  [[nodiscard]] void* lowest() const { return lowest_; }
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::size_t guard_bytes_;
  std::size_t bytes_;
  void* mapping_;
  void* lowest_;
};

}  // namespace nanomap
