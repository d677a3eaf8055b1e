#include <limits>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/depth_codec.h"

namespace nanomap {

Converted<CameraParameters> toCameraParameters(const camera_model_t& message) {
  // Storage for views is made by these numbers, and a thread in real time would die of what is absurd.
  if (!isImageSize(message.width, message.height)) return ConvertFault::kBadSize;

  CameraParameters parameters;
  parameters.width_px = message.width;
  parameters.height_px = message.height;
  parameters.fx_px = message.fx;
  parameters.fy_px = message.fy;
  parameters.cx_px = message.cx;
  parameters.cy_px = message.cy;
  const double(&k)[5] = message.distortion;
  parameters.distortion = {.k1 = k[0], .k2 = k[1], .p1 = k[2], .p2 = k[3], .k3 = k[4]};
  parameters.T_B_C = toPose(message.body_from_camera);
  parameters.depth_unit_m = message.depth_unit;
  parameters.min_range_m = message.min_range;
  parameters.max_range_m = message.max_range;
  parameters.no_return_values.clear();
  for (const std::int32_t value : message.no_return_values) {
    if (value < 0 || value > std::numeric_limits<std::uint16_t>::max()) return ConvertFault::kBadNoReturnValue;
    parameters.no_return_values.push_back(static_cast<std::uint16_t>(value));
  }
  return parameters;
}

camera_model_t toMessage(const CameraParameters& parameters, const std::string& name, Time stamp) {
  camera_model_t message{};
  message.utime = utimeFromTime(stamp);
  message.name = name;
  message.width = parameters.width_px;
  message.height = parameters.height_px;
  message.fx = parameters.fx_px;
  message.fy = parameters.fy_px;
  message.cx = parameters.cx_px;
  message.cy = parameters.cy_px;
  const Distortion& distortion = parameters.distortion;
  message.distortion[0] = distortion.k1;
  message.distortion[1] = distortion.k2;
  message.distortion[2] = distortion.p1;
  message.distortion[3] = distortion.p2;
  message.distortion[4] = distortion.k3;
  message.body_from_camera = toMessage(parameters.T_B_C);
  message.depth_unit = parameters.depth_unit_m;
  message.min_range = parameters.min_range_m;
  message.max_range = parameters.max_range_m;
  message.no_return_values.assign(parameters.no_return_values.begin(), parameters.no_return_values.end());
  message.num_no_return_values = static_cast<std::int32_t>(message.no_return_values.size());
  return message;
}

}  // namespace nanomap
