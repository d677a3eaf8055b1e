#include "firmware_app/pipeline/stuck_camera.h"

#include <algorithm>

namespace nanomap {
namespace {

/// Ends at the first difference, which is near the beginning for pictures with noise.
bool areAlike(const View& a, const View& b) {
  return std::ranges::equal(a.image().tiles(), b.image().tiles(),
                            [](const PixelTile& x, const PixelTile& y) { return x.raw == y.raw; });
}

bool showsAnything(const View& view) {
  return std::ranges::any_of(view.tiles().least(), [](std::uint16_t least) { return least != DepthTiles::kNoDepth; });
}

}  // namespace

bool StuckCamera::see(const ViewPtr& view, const std::optional<VehicleState>& state) {
  if (parameters_.images == 0) return false;
  const bool alike = first_ && areAlike(*first_, *view) && showsAnything(*view);
  const bool same_world = place_ && state && place_->epoch == state->epoch;
  if (!alike || !same_world) {
    stuck_ = stuck_ && alike;
    first_ = view;
    repeats_ = 0;
    place_.reset();
    if (state) place_ = Place{state->epoch, state->T_W_B};
    return stuck_;
  }
  ++repeats_;
  stuck_ = stuck_ || (repeats_ >= parameters_.images && hasMoved(*state));
  return stuck_;
}

bool StuckCamera::hasMoved(const VehicleState& state) const {
  const bool moved = (state.T_W_B.translation_m - place_->T_W_B.translation_m).norm() > parameters_.motion_m;
  return moved || state.T_W_B.rotation.angularDistance(place_->T_W_B.rotation) > parameters_.turn_rad;
}

}  // namespace nanomap
