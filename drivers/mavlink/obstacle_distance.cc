#include "drivers/mavlink/obstacle_distance.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/classify.h"
#include "core/level_frame.h"

namespace nanomap {
namespace {

constexpr double kCellWidth_rad = ObstacleDistances::kCellWidth_deg * std::numbers::pi / 180.0;
constexpr double kMaxMessage_cm = 65533.0;  // the two values above it have meanings of their own

std::uint16_t centimetres(double distance_m) {
  return static_cast<std::uint16_t>(std::clamp(std::floor(distance_m * 100.0), 0.0, kMaxMessage_cm));
}

/// The cell of a bearing in L, whose y axis points left where cells count clockwise.
std::size_t cellAt(double x_L_m, double y_L_m) {
  const auto cell = std::lround(std::atan2(-y_L_m, x_L_m) / kCellWidth_rad);
  const auto cells = static_cast<long>(ObstacleDistances::kCells);
  return static_cast<std::size_t>((cell + cells) % cells);
}

/// Is the view free up to `reach_m` at the body's height, across the whole cell?
bool isClear(const View& view, const Pose& T_C_L, std::size_t cell, double reach_m, const QueryOptions& options) {
  const Vec3 up_C = T_C_L.rotation * Vec3::UnitZ();
  constexpr double kAcross[] = {-0.4, -0.2, 0.0, 0.2, 0.4};  // of the cell's width
  return std::ranges::all_of(kAcross, [&](double across) {
    const double bearing_rad = -(static_cast<double>(cell) + across) * kCellWidth_rad;
    const Vec3 p_L{reach_m * std::cos(bearing_rad), reach_m * std::sin(bearing_rad), 0.0};
    const Status status = classify(view, T_C_L * p_L, Vec3::Zero(), up_C, options);
    return status == Status::kFree || status == Status::kOpen;
  });
}

}  // namespace

ObstacleDistances obstacleDistances(const View& view, const Pose& T_L_C, const ObstacleBand& band,
                                    const QueryOptions& options) {
  const CameraModel& camera = view.camera();
  // Not farther than the camera's range reaches from B's origin in every direction.
  const double reach_m = camera.frustum().far_m - T_L_C.translation_m.norm();
  ObstacleDistances distances;
  distances.stamp = view.stamp();
  distances.min_distance_cm = centimetres(camera.frustum().near_m);
  distances.max_distance_cm = centimetres(reach_m);

  const Eigen::Matrix3f R_L_C = T_L_C.rotation.toRotationMatrix().cast<float>();
  const Vec3f t_L_C = T_L_C.translation_m.cast<float>();
  for (int v = 0; v < camera.height(); ++v) {
    for (int u = 0; u < camera.width(); ++u) {
      const std::uint16_t raw = view.rawAt(u, v);
      const DepthReading reading = camera.classify(raw);
      if (reading != DepthReading::kInRange && reading != DepthReading::kTooNear) continue;
      const auto pixel =
          static_cast<std::size_t>(v) * static_cast<std::size_t>(camera.width()) + static_cast<std::size_t>(u);
      const Vec3 p_L = (R_L_C * camera.deproject(pixel, raw) + t_L_C).cast<double>();
      if (p_L.z() < -band.below_m || p_L.z() > band.above_m) continue;
      const double distance_m = p_L.head<2>().norm();
      if (distance_m > reach_m) continue;
      std::uint16_t& cell_cm = distances.cells_cm[cellAt(p_L.x(), p_L.y())];
      const bool touching = reading == DepthReading::kTooNear;
      cell_cm = std::min(cell_cm, touching ? ObstacleDistances::kTouching : centimetres(distance_m));
    }
  }

  const Pose T_C_L = T_L_C.inverse();
  for (std::size_t cell = 0; cell < ObstacleDistances::kCells; ++cell) {
    std::uint16_t& cell_cm = distances.cells_cm[cell];
    if (cell_cm == ObstacleDistances::kUnknown && isClear(view, T_C_L, cell, reach_m, options)) {
      cell_cm = distances.clear();
    }
  }
  return distances;
}

ObstacleDistances obstacleDistances(const ChainSnapshot& snapshot, const ObstacleBand& band,
                                    const QueryOptions& options) {
  if (snapshot.views.empty()) {
    ObstacleDistances unknown;
    unknown.stamp = snapshot.stamp;
    return unknown;
  }
  const SnapshotView& newest = snapshot.views.front();
  const Quat& R_W_B = snapshot.T_W_B.rotation;
  const Pose T_L_B{Quat(levelAxes(yawOf(R_W_B))).conjugate() * R_W_B, Vec3::Zero()};
  const Pose T_C_B{Quat(newest.R_C_B), newest.t_C_B_m};
  return obstacleDistances(*newest.view, T_L_B * T_C_B.inverse(), band, options);
}

}  // namespace nanomap
