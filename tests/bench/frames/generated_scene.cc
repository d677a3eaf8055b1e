#include "tests/bench/frames/generated_scene.h"

#include <chrono>
#include <cmath>
#include <cstdint>
#include <memory>
#include <numbers>

#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr Duration kFramePeriod = std::chrono::microseconds(33'333);
constexpr Duration kPosePeriod = std::chrono::milliseconds(10);
/// Into the flight: past the take-off, among the obstacles.
constexpr Duration kStart = std::chrono::seconds(3);

/// What a controller leaves of a hover: a few centimetres and degrees.
Pose sway(Duration t) {
  constexpr double kAmplitude_m = 0.05;
  constexpr double kAmplitude_rad = 0.03;
  const double phase_rad = 2.0 * std::numbers::pi * toSeconds(t);
  const Eigen::AngleAxisd yaw(kAmplitude_rad * std::sin(0.3 * phase_rad), Vec3::UnitZ());
  return {Quat(yaw), kAmplitude_m * Vec3(std::sin(0.5 * phase_rad), std::sin(0.7 * phase_rad), std::cos(phase_rad))};
}

simulation::DepthSensorParameters sensorWith(Noise noise) {
  constexpr double kPatchShare = 1.0 / 3.0;
  if (noise == Noise::kClean) return simulation::DepthSensorParameters::ideal();
  simulation::DepthSensorParameters sensor;
  if (noise == Noise::kPatchy) sensor.patch_share = kPatchShare;
  return sensor;
}

simulation::FlightPath pathThrough(std::string_view name) { return {simulation::makeScene(name, kSeed), {}, kSeed}; }

}  // namespace

GeneratedScene::GeneratedScene(std::string_view name)
    : path_(pathThrough(name)), caster_(simulation::makeScene(name, kSeed).mesh()) {}

RecordedFlight GeneratedScene::fly(const CameraParameters& camera, Noise noise, FrameRange frames) const {
  return record(camera, noise, frames, [&](Duration t) { return path_.at(kStart + t).T_W_B; });
}

RecordedFlight GeneratedScene::hover(const CameraParameters& camera, Noise noise, FrameRange frames) const {
  const Pose T_W_hover = path_.at(path_.duration() / 2).T_W_B;
  return record(camera, noise, frames, [&](Duration t) { return T_W_hover * sway(t); });
}

template <class PoseAt>
RecordedFlight GeneratedScene::record(const CameraParameters& camera, Noise noise, FrameRange frames,
                                      PoseAt&& poseAt) const {
  RecordedFlight flight;
  flight.camera = std::make_shared<const CameraModel>(camera);
  const simulation::DepthSensor sensor(*flight.camera, sensorWith(noise), kSeed);
  const auto timeOf = [](std::size_t frame) { return kFramePeriod * static_cast<std::int64_t>(frame); };
  const std::size_t end = frames.first + frames.count;
  for (Duration t = timeOf(frames.first) - kPosePeriod; t <= timeOf(end) + kPosePeriod; t += kPosePeriod) {
    flight.poses.push_back(
        {.stamp = Time(kStart + t), .T_W_B = poseAt(t), .epoch = 0, .sequence = flight.poses.size(), .increment = {}});
  }
  for (std::size_t i = frames.first; i < end; ++i) {
    const Duration t = timeOf(i);
    flight.frames.push_back(
        sensor.measure(caster_.render(*flight.camera, poseAt(t) * camera.T_B_C), Time(kStart + t), i));
  }
  return flight;
}

}  // namespace nanomap::bench
