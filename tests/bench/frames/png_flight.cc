#include "tests/bench/frames/png_flight.h"

#include <chrono>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>

#include "tools/import/depth_png.h"
#include "tools/import/numbered_layout.h"

namespace nanomap::bench {

RecordedFlight readPngFlight(const std::filesystem::path& folder, const CameraParameters& camera,
                             std::size_t max_frames) {
  constexpr double kRate_hz = 30.0;
  constexpr Duration kAround = std::chrono::milliseconds(10);
  RecordedFlight flight;
  flight.camera = std::make_shared<const CameraModel>(camera);
  const Recording recording = select(readNumberedLayout(folder, kRate_hz), 1, max_frames);
  const Pose T_C_B = camera.T_B_C.inverse();
  for (const RecordedImage& recorded : recording.images) {
    DepthPng png = readDepthPng(recorded.file);
    DepthImage image{recorded.stamp, recorded.sequence,   png.width_px,
                     png.height_px,  camera.depth_unit_m, std::move(png.pixels)};
    if (const auto fault = faultOf(image, *flight.camera)) {
      throw std::runtime_error(recorded.file.string() + ": " + std::string(toString(*fault)));
    }
    flight.frames.push_back(std::move(image));
  }
  for (const RecordedPose& recorded : recording.poses) {
    flight.poses.push_back({recorded.stamp, recorded.T_W_C * T_C_B, 0, 0, {}});
  }
  // The vehicle stands still before the first frame and after the last, so that poses surround every frame.
  BodyPose before = flight.poses.front();
  before.stamp -= kAround;
  BodyPose after = flight.poses.back();
  after.stamp += kAround;
  flight.poses.insert(flight.poses.begin(), before);
  flight.poses.push_back(after);
  return flight;
}

}  // namespace nanomap::bench
