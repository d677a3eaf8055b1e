#include "tools/simulation/depth_sensor.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/simulation/random.h"

namespace nanomap::simulation {
namespace {

constexpr std::uint16_t kNoReturn = 0;
constexpr std::uint16_t kLargestReturn =
    std::numeric_limits<std::uint16_t>::max() - 1;  // the largest one is "no return"

void require(bool holds, const char* name, double value, const char* rule) {
  if (holds) return;
  throw std::invalid_argument(std::string("depth sensor: ") + name + " is " + std::to_string(value) + ", must be " +
                              rule);
}

/// Marks the pixels of a row that the left imager sees and the right one does not: along the row, something nearer
/// covers them there. In the right image a pixel at column u with disparity d lies at u - d; whatever has a pixel to
/// its right that lies at or beyond it is covered.
void markShadows(std::span<const float> row_depth_m, double focal_baseline_px_m, std::vector<bool>& shadowed) {
  double covered_from_px = std::numeric_limits<double>::infinity();
  for (std::size_t u = row_depth_m.size(); u-- > 0;) {
    const double right_px = static_cast<double>(u) - focal_baseline_px_m / static_cast<double>(row_depth_m[u]);
    shadowed[u] = right_px >= covered_from_px;
    covered_from_px = std::min(covered_from_px, right_px);
  }
}

/// Loses ellipses of 2 to 12 % of the image's width and height, until they cover `share` of it.
void losePatches(DepthImage& image, double share, Random& random) {
  constexpr double kLeastHalfAxis = 0.01;
  constexpr double kMostHalfAxis = 0.06;
  std::vector<bool> lost(image.pixels.size(), false);
  const double wanted = share * static_cast<double>(lost.size());
  for (std::size_t count = 0; static_cast<double>(count) < wanted;) {
    const double middle_u = uniform(random, 0.0, image.width_px);
    const double middle_v = uniform(random, 0.0, image.height_px);
    const double half_u = image.width_px * uniform(random, kLeastHalfAxis, kMostHalfAxis);
    const double half_v = image.height_px * uniform(random, kLeastHalfAxis, kMostHalfAxis);
    const int end_u = std::min(static_cast<int>(middle_u + half_u) + 1, image.width_px);
    const int end_v = std::min(static_cast<int>(middle_v + half_v) + 1, image.height_px);
    for (int v = std::max(static_cast<int>(middle_v - half_v), 0); v < end_v; ++v) {
      for (int u = std::max(static_cast<int>(middle_u - half_u), 0); u < end_u; ++u) {
        const auto i = static_cast<std::size_t>(v * image.width_px + u);
        if (lost[i] || std::hypot((u - middle_u) / half_u, (v - middle_v) / half_v) >= 1.0) continue;
        lost[i] = true;
        image.pixels[i] = kNoReturn;
        ++count;
      }
    }
  }
}

}  // namespace

DepthSensorParameters DepthSensorParameters::ideal() {
  DepthSensorParameters ideal;
  ideal.noise_constant_m = 0.0;
  ideal.noise_quadratic_per_m = 0.0;
  ideal.dropout_probability = 0.0;
  ideal.stereo_baseline_m = 0.0;
  return ideal;
}

DepthSensor::DepthSensor(const CameraModel& camera, const DepthSensorParameters& parameters, std::uint64_t seed)
    : camera_(&camera), parameters_(parameters), seed_(seed) {
  const DepthSensorParameters& p = parameters_;
  require(p.min_range_m >= 0.0, "min_range_m", p.min_range_m, "0 or more");
  require(p.max_range_m > p.min_range_m, "max_range_m", p.max_range_m, "above min_range_m");
  require(p.noise_constant_m >= 0.0, "noise_constant_m", p.noise_constant_m, "0 or more");
  require(p.noise_quadratic_per_m >= 0.0, "noise_quadratic_per_m", p.noise_quadratic_per_m, "0 or more");
  require(p.dropout_probability >= 0.0 && p.dropout_probability <= 1.0, "dropout_probability", p.dropout_probability,
          "in 0..1");
  require(p.patch_share >= 0.0 && p.patch_share <= 0.9, "patch_share", p.patch_share, "in 0..0.9");
  require(p.stereo_baseline_m >= 0.0, "stereo_baseline_m", p.stereo_baseline_m, "0 or more");
  require(p.disparity_step_px >= 0.0, "disparity_step_px", p.disparity_step_px, "0 or more");
}

DepthImage DepthSensor::measure(std::span<const float> depth_m, Time stamp, std::uint64_t sequence) const {
  if (depth_m.size() != camera_->pixelCount()) {
    throw std::invalid_argument("depth sensor: " + std::to_string(depth_m.size()) + " depths given for " +
                                std::to_string(camera_->pixelCount()) + " pixels");
  }
  const CameraParameters& camera = camera_->parameters();
  DepthImage image;
  image.stamp = stamp;
  image.sequence = sequence;
  image.width_px = camera.width_px;
  image.height_px = camera.height_px;
  image.depth_unit_m = camera.depth_unit_m;
  image.pixels.assign(depth_m.size(), kNoReturn);

  std::seed_seq frame_seed{seed_ & 0xffffffffU, seed_ >> 32U, sequence & 0xffffffffU, sequence >> 32U};
  Random random(frame_seed);
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> share;
  const double focal_baseline_px_m = camera.fx_px * parameters_.stereo_baseline_m;
  const double disparity_step_px = focal_baseline_px_m > 0.0 ? parameters_.disparity_step_px : 0.0;
  const auto width = static_cast<std::size_t>(camera.width_px);
  std::vector<bool> shadowed(width, false);
  for (std::size_t row = 0; row < depth_m.size(); row += width) {
    if (focal_baseline_px_m > 0.0) markShadows(depth_m.subspan(row, width), focal_baseline_px_m, shadowed);
    for (std::size_t u = 0; u < width; ++u) {
      const double true_m = static_cast<double>(depth_m[row + u]);
      if (shadowed[u] || !(true_m >= parameters_.min_range_m && true_m <= parameters_.max_range_m) ||
          share(random) < parameters_.dropout_probability) {
        continue;
      }
      const double noise_m = parameters_.noise_constant_m + parameters_.noise_quadratic_per_m * true_m * true_m;
      double measured_m = true_m + noise_m * normal(random);
      if (disparity_step_px > 0.0) {
        const double steps = std::round(focal_baseline_px_m / measured_m / disparity_step_px);
        measured_m = focal_baseline_px_m / (steps * disparity_step_px);
      }
      const double counts = std::round(measured_m / camera.depth_unit_m);
      if (counts >= 1.0 && counts <= kLargestReturn) image.pixels[row + u] = static_cast<std::uint16_t>(counts);
    }
  }
  if (parameters_.patch_share > 0.0) losePatches(image, parameters_.patch_share, random);
  return image;
}

}  // namespace nanomap::simulation
