#include "tests/bench/references/fused_grid.h"

#include <dynamicEDT3D/dynamicEDTOctomap.h>
#include <octomap/octomap.h>

#include "tests/bench/references/point_cloud.h"

namespace nanomap::bench {
namespace {

octomap::point3d toOctomap(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}

}  // namespace

struct FusedGrid::Maps {
  explicit Maps(const Vec3& center_W)
      : occupancy(kCell_m),
        distances(static_cast<float>(kMaxDistance_m), &occupancy, toOctomap(center_W - Vec3::Constant(kReach_m)),
                  toOctomap(center_W + Vec3::Constant(kReach_m)), false) {
    occupancy.enableChangeDetection(true);
  }

  octomap::OcTree occupancy;
  DynamicEDTOctomap distances;
};

FusedGrid::FusedGrid(const Vec3& center_W) : maps_(std::make_unique<Maps>(center_W)) {}
FusedGrid::~FusedGrid() = default;

void FusedGrid::insert(const DepthImage& image, const CameraModel& camera, const Pose& T_W_B) {
  const Pose T_W_C = T_W_B * camera.parameters().T_B_C;
  octomap::Pointcloud cloud_W;
  for (const Vec3f& point_C : pointCloud(image, camera)) cloud_W.push_back(toOctomap(T_W_C * point_C.cast<double>()));
  constexpr bool kLazy = true;        // inner nodes are brought up to date once, below
  constexpr bool kDiscretize = true;  // one ray a cell, not one a point: several times faster
  maps_->occupancy.insertPointCloud(cloud_W, toOctomap(T_W_C.translation_m), camera.parameters().max_range_m, kLazy,
                                    kDiscretize);
  maps_->occupancy.updateInnerOccupancy();
  maps_->distances.update();
}

float FusedGrid::distance_m(const Vec3& p_W) const { return maps_->distances.getDistance(toOctomap(p_W)); }

}  // namespace nanomap::bench
