#pragma once

#include <cstddef>
#include <string_view>

#include "core/camera_model.h"
#include "tests/bench/frames/recorded_flight.h"
#include "tools/simulation/flight_path.h"
#include "tools/simulation/ray_caster.h"

namespace nanomap::bench {

/// Of the sensor. A patchy one loses a third of each frame in patches, too.
enum class Noise { kClean, kNoisy, kPatchy };

/// A simulated scene, and a flight through it to take depth frames from: 30 Hz, poses at 100 Hz. The same every time.
class GeneratedScene {
 public:
  /// @throws std::exception naming the scene, if it is unknown or cannot be flown
  explicit GeneratedScene(std::string_view name);

  /// Which frames of a recording are wanted.
  struct FrameRange {
    std::size_t first = 0;
    std::size_t count = 0;
  };

  /// The vehicle flies: 7 m/s, weaving, braking now and then.
  [[nodiscard]] RecordedFlight fly(const CameraParameters& camera, Noise noise, FrameRange frames) const;

  /// The vehicle hovers, in the middle of the scene: it sways by centimetres, so that every frame sees nearly the same.
  [[nodiscard]] RecordedFlight hover(const CameraParameters& camera, Noise noise, FrameRange frames) const;

 private:
  template <class PoseAt>
  [[nodiscard]] RecordedFlight record(const CameraParameters& camera, Noise noise, FrameRange frames,
                                      PoseAt&& poseAt) const;

  simulation::FlightPath path_;
  simulation::RayCaster caster_;
};

}  // namespace nanomap::bench
