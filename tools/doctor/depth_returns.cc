#include "tools/doctor/depth_returns.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nanomap::doctor {

DepthReturns::DepthReturns(const Heard& heard, const CameraModel& camera) {
  constexpr std::size_t kStep = 17;  // pixels; prime, so that it walks through all columns
  for (const DepthInput& frame : heard.frames) {
    for (std::size_t pixel = 0; pixel < frame.image.pixels.size(); pixel += kStep) {
      const std::uint16_t raw = frame.image.pixels[pixel];
      if (camera.classify(raw) != DepthReading::kNone) ascending_.push_back(raw);
    }
  }
  std::ranges::sort(ascending_);
}

double DepthReturns::median_m(double unit_m) const { return unit_m * ascending_[ascending_.size() / 2]; }

double DepthReturns::shareInRange(const CameraParameters& camera, double unit_m) const {
  if (ascending_.empty()) return 0.0;
  const auto below = [&](double limit_m) {
    return std::ranges::count_if(ascending_, [&](std::uint16_t raw) { return raw * unit_m < limit_m; });
  };
  const auto within = below(camera.max_range_m) - below(camera.min_range_m);
  return static_cast<double>(within) / static_cast<double>(ascending_.size());
}

}  // namespace nanomap::doctor
