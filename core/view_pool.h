#pragma once

#include <cstddef>
#include <memory>
#include <variant>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/view.h"

namespace nanomap {

/// Stage T2: depth images of one camera to views, in storage that comes back when the last owner lets a view go.
/// Threads: one builds; views are let go from any, also after the pool is gone.
class ViewPool {
 public:
  /// Allocates storage for `reserved` views.
  ViewPool(std::shared_ptr<const CameraModel> camera, IndexKind kind, std::size_t reserved);
  ~ViewPool();
  ViewPool(ViewPool&&) noexcept;
  ViewPool& operator=(ViewPool&&) noexcept;

  /// A checked image with its index built, or the reason why not.
  /// Allocates: storage for one more view, if all are in use; and with IndexKind::kFlann.
  [[nodiscard]] std::variant<ViewPtr, ImageFault> build(const DepthImage& image);

  /// Views there is storage for.
  [[nodiscard]] std::size_t capacity() const { return slots_.size(); }

 private:
  struct Slot;
  template <class T>
  class SlotAllocator;

  [[nodiscard]] const std::shared_ptr<Slot>& freeSlot();

  std::shared_ptr<const CameraModel> camera_;
  IndexKind kind_;
  std::vector<std::shared_ptr<Slot>> slots_;
  std::size_t next_ = 0;  ///< where to look first: the oldest views are let go first
};

}  // namespace nanomap
