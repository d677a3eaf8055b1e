#pragma once

#include <cstdint>
#include <optional>

#include "core/pose_buffer.h"
#include "core/vehicle_state.h"
#include "core/view.h"
#include "firmware_app/safety/safety_parameters.h"

namespace nanomap {

/// Notices a camera that shows the same picture again and again under new stamps, while the vehicle moves. Two pictures
/// of a real sensor differ by their noise; those of a simulated one, or of a bench, may be alike while nothing moves,
/// and a picture without a single return is what every camera sees of an empty sky: that one says nothing.
/// A function of what it was given, in that order. Threads: one. Allocates: no.
class StuckCamera {
 public:
  explicit StuckCamera(const StuckDepthParameters& parameters) : parameters_(parameters) {}

  /// The next picture. @param state  of the vehicle, as it is known now
  /// @return is the camera stuck?
  [[nodiscard]] bool see(const ViewPtr& view, const std::optional<VehicleState>& state);

  /// By the last picture.
  [[nodiscard]] bool isStuck() const { return stuck_; }

 private:
  /// What the picture was first seen at.
  struct Place {
    std::uint32_t epoch = 0;
    Pose T_W_B;
  };

  [[nodiscard]] bool hasMoved(const VehicleState& state) const;

  StuckDepthParameters parameters_;
  ViewPtr first_;  ///< of those that are alike
  std::optional<Place> place_;
  int repeats_ = 0;
  bool stuck_ = false;
};

}  // namespace nanomap
