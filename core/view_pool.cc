#include "core/view_pool.h"

#include <array>
#include <atomic>
#include <cstddef>
#include <utility>

namespace nanomap {

/// Storage of one view and of what counts its owners.
struct ViewPool::Slot {
  Slot(std::shared_ptr<const CameraModel> camera, IndexKind kind) : view(std::move(camera), kind) {}

  /// More than any standard library's control block with a pointer, a deleter and an allocator.
  static constexpr std::size_t kControlBlockBytes = 128;

  View view;
  std::atomic<bool> in_use{false};
  alignas(std::max_align_t) std::array<std::byte, kControlBlockBytes> control_block{};
};

/// Places a shared pointer's control block in its view's slot. When the control block goes, nobody can reach the view
/// any more: the slot is free then, and not when the deleter runs.
template <class T>
class ViewPool::SlotAllocator {
 public:
  using value_type = T;

  explicit SlotAllocator(std::shared_ptr<Slot> slot) : slot_(std::move(slot)) {}
  template <class U>
  SlotAllocator(const SlotAllocator<U>& other) : slot_(other.slot()) {}  // NOLINT: converts, as allocators do

  [[nodiscard]] T* allocate(std::size_t) {
    static_assert(sizeof(T) <= Slot::kControlBlockBytes && alignof(T) <= alignof(std::max_align_t));
    return static_cast<T*>(static_cast<void*>(slot_->control_block.data()));
  }
  void deallocate(T*, std::size_t) noexcept { slot_->in_use.store(false, std::memory_order_release); }

  [[nodiscard]] const std::shared_ptr<Slot>& slot() const { return slot_; }
  template <class U>
  bool operator==(const SlotAllocator<U>& other) const {
    return slot_ == other.slot();
  }

 private:
  std::shared_ptr<Slot> slot_;
};

ViewPool::ViewPool(std::shared_ptr<const CameraModel> camera, IndexKind kind, std::size_t reserved)
    : camera_(std::move(camera)), kind_(kind) {
  slots_.reserve(reserved);
  while (slots_.size() < reserved) slots_.push_back(std::make_shared<Slot>(camera_, kind_));
}

ViewPool::~ViewPool() = default;
ViewPool::ViewPool(ViewPool&&) noexcept = default;
ViewPool& ViewPool::operator=(ViewPool&&) noexcept = default;

std::variant<ViewPtr, ImageFault> ViewPool::build(const DepthImage& image) {
  if (const auto fault = faultOf(image, *camera_)) return *fault;
  const std::shared_ptr<Slot>& slot = freeSlot();
  slot->view.assign(image);
  slot->in_use.store(true, std::memory_order_relaxed);
  const auto keep = [](const View*) {};
  return ViewPtr(&slot->view, keep, SlotAllocator<View>(slot));
}

const std::shared_ptr<ViewPool::Slot>& ViewPool::freeSlot() {
  for (std::size_t tried = 0; tried < slots_.size(); ++tried) {
    next_ = (next_ + 1) % slots_.size();
    if (!slots_[next_]->in_use.load(std::memory_order_acquire)) return slots_[next_];
  }
  slots_.push_back(std::make_shared<Slot>(camera_, kind_));
  return slots_.back();
}

}  // namespace nanomap
