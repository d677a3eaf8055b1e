#pragma once

#include <cassert>
#include <cstddef>
#include <utility>
#include <vector>

namespace nanomap {

/// Sequence of at most `capacity` values, front to back, with O(1) insertion and removal at both its ends.
/// Allocates at construction only. Removed values are reset at once, so that what they own is released then.
template <class T>
class RingBuffer {
 public:
  explicit RingBuffer(std::size_t capacity) : slots_(capacity) { assert(capacity > 0); }

  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] bool full() const { return size_ == slots_.size(); }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

  [[nodiscard]] T& operator[](std::size_t i) {
    assert(i < size_);
    return slots_[wrap(first_ + i)];
  }
  [[nodiscard]] const T& operator[](std::size_t i) const {
    assert(i < size_);
    return slots_[wrap(first_ + i)];
  }
  [[nodiscard]] T& front() { return (*this)[0]; }
  [[nodiscard]] const T& front() const { return (*this)[0]; }
  [[nodiscard]] T& back() { return (*this)[size_ - 1]; }
  [[nodiscard]] const T& back() const { return (*this)[size_ - 1]; }

  /// @pre not full
  void pushBack(T value) {
    assert(!full());
    slots_[wrap(first_ + size_)] = std::move(value);
    ++size_;
  }
  /// @pre not full
  void pushFront(T value) {
    assert(!full());
    first_ = wrap(first_ + slots_.size() - 1);
    slots_[first_] = std::move(value);
    ++size_;
  }
  /// Before position `i`; moves what lies behind it. @pre not full, i <= size()
  void insert(std::size_t i, T value) {
    assert(i <= size_);
    pushBack(std::move(value));
    for (std::size_t j = size_ - 1; j > i; --j) std::swap((*this)[j], (*this)[j - 1]);
  }
  /// @pre not empty
  void popFront() {
    front() = T();
    first_ = wrap(first_ + 1);
    --size_;
  }
  /// @pre not empty
  void popBack() {
    back() = T();
    --size_;
  }

 private:
  [[nodiscard]] std::size_t wrap(std::size_t slot) const { return slot < slots_.size() ? slot : slot - slots_.size(); }

  std::vector<T> slots_;
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace nanomap
