#pragma once

#include <cstdint>
#include <vector>

#include "core/camera_model.h"
#include "tools/doctor/heard.h"

namespace nanomap::doctor {

/// Raw depths of what was heard: a sample of the pixels with a return, whatever its distance.
class DepthReturns {
 public:
  DepthReturns(const Heard& heard, const CameraModel& camera);

  [[nodiscard]] bool empty() const { return ascending_.empty(); }

  /// @pre not empty
  [[nodiscard]] double median_m(double unit_m) const;

  /// The share of them that is within the camera's range at that many metres a count, 0 to 1; 0 of none.
  [[nodiscard]] double shareInRange(const CameraParameters& camera, double unit_m) const;

 private:
  std::vector<std::uint16_t> ascending_;
};

}  // namespace nanomap::doctor
