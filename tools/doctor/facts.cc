#include "tools/doctor/facts.h"

namespace nanomap::doctor {

std::optional<CameraParameters> Facts::camera() const {
  if (configuration.camera) return configuration.camera;
  if (heard && heard->camera) return heard->camera->parameters;
  return std::nullopt;
}

}  // namespace nanomap::doctor
