#pragma once

#include <cstdint>
#include <span>

#include "core/camera_model.h"
#include "core/depth_image.h"
#include "core/time.h"

namespace nanomap::simulation {

/// What a real depth sensor does to the depth that is there. The defaults resemble an active stereo camera with 95 mm
/// baseline that matches at four times the width of a 320 pixel image in steps of 1/32 pixel. The range limit lies
/// beyond what the camera model trusts: such returns say "free at least that far".
struct DepthSensorParameters {
  double min_range_m = 0.3;         ///< nothing nearer gives a return
  double max_range_m = 40.0;        ///< nothing farther does
  double noise_constant_m = 0.002;  ///< standard deviation at depth z: constant + quadratic * z^2
  double noise_quadratic_per_m = 0.0008;
  double dropout_probability = 0.002;      ///< of each pixel, by itself
  double patch_share = 0.0;                ///< of the image, without depth in patches: no texture, or glare
  double stereo_baseline_m = 0.095;        ///< to the right imager; 0: no stereo, neither shadows nor disparity steps
  double disparity_step_px = 1.0 / 128.0;  ///< in pixels of the depth image; 0: disparities are not quantised

  /// Only range limits and the depth unit remain.
  [[nodiscard]] static DepthSensorParameters ideal();
};

/// Turns rendered depth into what the sensor would have reported: shadows at depth edges, dropouts, patches, range
/// limits, noise that grows with range, steps of disparity and of the depth unit. A function of its arguments and the
/// seed: the noise of a frame depends on its sequence number, not on what was measured before. Threads: immutable, any
/// number of readers.
class DepthSensor {
 public:
  /// `camera` must outlive the sensor.
  /// @throws std::invalid_argument naming the parameter and its value
  DepthSensor(const CameraModel& camera, const DepthSensorParameters& parameters, std::uint64_t seed);

  /// @param depth_m  depth along the optical axis, row-major, infinity for none
  /// @throws std::invalid_argument if it is not one value a pixel
  [[nodiscard]] DepthImage measure(std::span<const float> depth_m, Time stamp, std::uint64_t sequence) const;

 private:
  const CameraModel* camera_;
  DepthSensorParameters parameters_;
  std::uint64_t seed_;
};

}  // namespace nanomap::simulation
