#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/body_convention.h"
#include "nanomap/camera_model_t.hpp"
#include "nanomap/depth_image_t.hpp"

namespace nanomap::test {

/// A message of a recorded flight.
struct RecordedMessage {
  std::string channel;
  Time arrival{};
  std::vector<std::uint8_t> bytes;
};

/// What somebody has done wrong where messages are sent.
struct Mistake {
  std::function<void(camera_model_t&)> camera = [](camera_model_t&) {};
  std::function<void(depth_image_t&)> depth = [](depth_image_t&) {};
  std::optional<BodyConvention> pose_t{};  ///< poses are bot_core.pose_t, of such a body
};

/// Some seconds through the forest, with noise and drift; the same each time.
[[nodiscard]] const std::vector<RecordedMessage>& healthyFlight();

/// The flight with a mistake, written to `path`.
std::filesystem::path writeFlight(const std::filesystem::path& path, const Mistake& mistake);

}  // namespace nanomap::test
