#pragma once

#include <memory>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/geometry.h"

namespace nanomap::bench {

/// OctoMap with its Euclidean distance map (dynamicEDT3D): what one would use instead of keeping views. It is another
/// thing: frames are fused into one grid in W, so that pose errors stay in it for good, and distances are between cell
/// centres, of a box around the vehicle, up to a limit. Not exact, and no reference for distances; it is timed only.
class FusedGrid {
 public:
  static constexpr double kCell_m = 0.2;
  static constexpr double kReach_m = 10.0;       ///< of the box around the place where the grid is made
  static constexpr double kMaxDistance_m = 5.0;  ///< beyond it distances are cut off

  explicit FusedGrid(const Vec3& center_W);
  ~FusedGrid();

  /// Casts a ray for each cell that `image` has a return in, at most to the camera's range, and updates distances.
  void insert(const DepthImage& image, const CameraModel& camera, const Pose& T_W_B);

  /// To the centre of the nearest occupied cell [m]; negative outside the box.
  [[nodiscard]] float distance_m(const Vec3& p_W) const;

 private:
  struct Maps;
  std::unique_ptr<Maps> maps_;
};

}  // namespace nanomap::bench
