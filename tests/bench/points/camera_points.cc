#include "tests/bench/points/camera_points.h"

#include <algorithm>
#include <stdexcept>

#include "planner/primitive_library.h"

namespace nanomap::bench {
namespace {

constexpr unsigned kUniformSeed = 5;
constexpr unsigned kPrimitiveSeed = 6;
constexpr int kMaxTries = 100'000;

/// In the frustum's sides, and not behind a return?
bool isFree(const DepthImage& image, const CameraModel& camera, const Vec3f& p_C) {
  const auto z_m = static_cast<double>(p_C.z());
  if (!(z_m > camera.frustum().near_m)) return false;
  const auto pixel = camera.pixelAt(static_cast<double>(p_C.x()) / z_m, static_cast<double>(p_C.y()) / z_m);
  if (!pixel) return false;
  const std::uint16_t raw = image.pixels[static_cast<std::size_t>(pixel->v * camera.width() + pixel->u)];
  return camera.classify(raw) == DepthReading::kNone || p_C.z() < camera.depth(raw);
}

[[noreturn]] void failToDraw() {
  throw std::runtime_error("no free point in the depth frame: is something held before the camera?");
}

}  // namespace

Vec3f drawFreePoint(const DepthImage& image, const CameraModel& camera, std::mt19937& random) {
  constexpr double kLeast_m = 0.5;
  constexpr double kMost_m = 15.0;
  std::uniform_int_distribution<std::size_t> pixel(0, camera.pixelCount() - 1);
  std::uniform_real_distribution<float> distance_m(
      static_cast<float>(kLeast_m), static_cast<float>(std::min(kMost_m, camera.parameters().max_range_m)));
  for (int i = 0; i < kMaxTries; ++i) {
    const Eigen::Vector2f tangents = camera.rayTangents(pixel(random));
    const Vec3f p_C = distance_m(random) * Vec3f(tangents.x(), tangents.y(), 1.0F).normalized();
    if (isFree(image, camera, p_C)) return p_C;
  }
  failToDraw();
}

std::vector<Vec3f> uniformPoints(const DepthImage& image, const CameraModel& camera, std::size_t count) {
  std::mt19937 random(kUniformSeed);
  std::vector<Vec3f> points_C;
  while (points_C.size() < count) points_C.push_back(drawFreePoint(image, camera, random));
  return points_C;
}

std::vector<Vec3f> primitivePoints(const DepthImage& image, const CameraModel& camera, std::size_t count) {
  constexpr int kSamples = 20;
  constexpr double kHorizon_s = 2.0;
  constexpr double kMaxForward_m_s = 8.0;
  constexpr double kMaxSideways_m_s = 1.0;
  std::mt19937 random(kPrimitiveSeed);
  std::uniform_real_distribution<double> forward_m_s(0.0, kMaxForward_m_s);
  std::uniform_real_distribution<double> sideways_m_s(-kMaxSideways_m_s, kMaxSideways_m_s);
  const PrimitiveLibrary library;
  const MotionLimits limits;
  const Pose T_C_B = camera.parameters().T_B_C.inverse();
  std::vector<Vec3f> points_C;
  for (int tries = 0; points_C.size() < count; ++tries) {
    if (tries == kMaxTries) failToDraw();
    const Vec3 velocity_L_m_s(forward_m_s(random), sideways_m_s(random), sideways_m_s(random));
    for (std::uint32_t index = 0; index < kLibrarySize; ++index) {
      const Vec3 acceleration_L_m_s2 = library.acceleration_L(index, limits, velocity_L_m_s.norm());
      const Trajectory motion_L = primitive(Time{}, {Vec3::Zero(), velocity_L_m_s, Vec3::Zero()}, acceleration_L_m_s2,
                                            {.push_s = kHorizon_s, .horizon_s = kHorizon_s}, limits);
      for (int sample = 1; sample <= kSamples; ++sample) {
        const Vec3 p_B = motion_L.sample(kHorizon_s * sample / kSamples).position_m;
        const Vec3f p_C = (T_C_B * p_B).cast<float>();
        if (isFree(image, camera, p_C)) points_C.push_back(p_C);
      }
    }
  }
  // Neighbours in the list are neighbours in space, as in a plan; what is left out is left out evenly.
  const std::size_t stride = points_C.size() / count;
  for (std::size_t i = 0; i < count; ++i) points_C[i] = points_C[i * stride];
  points_C.resize(count);
  return points_C;
}

}  // namespace nanomap::bench
