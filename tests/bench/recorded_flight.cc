#include "tests/bench/recorded_flight.h"

#include <cmath>
#include <numbers>
#include <variant>

#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/flight_path.h"
#include "tools/simulation/ray_caster.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::bench {
namespace {

constexpr std::uint64_t kSeed = 1;
constexpr Duration kFramePeriod = std::chrono::microseconds(33'333);
constexpr Duration kPosePeriod = std::chrono::milliseconds(10);
/// Into the flight: past the take-off, among the trees.
constexpr Duration kStart = std::chrono::seconds(3);

CameraParameters paperCamera() {
  const auto focalLength = [](int size_px, double fov_deg) {
    return size_px / 2.0 / std::tan(fov_deg / 2.0 * std::numbers::pi / 180.0);
  };
  CameraParameters camera;
  camera.width_px = 320;
  camera.height_px = 240;
  camera.fx_px = focalLength(320, 90.0);
  camera.fy_px = focalLength(240, 60.0);
  camera.cx_px = 159.5;
  camera.cy_px = 119.5;
  Mat3 R_B_C;
  R_B_C << 0, 0, 1, -1, 0, 0, 0, -1, 0;
  camera.T_B_C.rotation = Quat(R_B_C);
  camera.min_range_m = 0.3;
  camera.max_range_m = 20.0;
  return camera;
}

}  // namespace

RecordedFlight recordFlight(std::size_t frame_count) {
  RecordedFlight flight;
  flight.camera = std::make_shared<const CameraModel>(paperCamera());
  const simulation::Scene scene = simulation::makeScene("forest", kSeed);
  const simulation::RayCaster caster(scene.mesh());
  const simulation::FlightPath path(scene, {}, kSeed);
  const simulation::DepthSensor sensor(*flight.camera, {}, kSeed);
  const Pose& T_B_C = flight.camera->parameters().T_B_C;

  const Duration end = kFramePeriod * static_cast<std::int64_t>(frame_count);
  for (Duration t = -kPosePeriod; t <= end + kPosePeriod; t += kPosePeriod) {
    flight.poses.push_back({.stamp = Time(t + kStart),
                            .T_W_B = path.at(t + kStart).T_W_B,
                            .epoch = 0,
                            .sequence = flight.poses.size(),
                            .increment = {}});
  }
  for (std::size_t i = 0; i < frame_count; ++i) {
    const Duration t = kStart + kFramePeriod * static_cast<std::int64_t>(i);
    flight.frames.push_back(sensor.measure(caster.render(*flight.camera, path.at(t).T_W_B * T_B_C), Time(t), i));
  }
  return flight;
}

Chain chainOf(const RecordedFlight& flight) {
  ChainParameters parameters;
  parameters.history_views = flight.frames.size();
  parameters.drift = {.horizontal_std_m = 0.2, .vertical_std_m = 0.05};
  Chain chain(parameters);
  for (const BodyPose& pose : flight.poses) (void)chain.addPose(pose);
  for (const DepthImage& frame : flight.frames) {
    (void)chain.addView(std::get<ViewPtr>(buildView(frame, flight.camera)));
  }
  return chain;
}

}  // namespace nanomap::bench
