#include "core/depth_gap.h"

#include <algorithm>

namespace nanomap {
namespace {

struct Step {
  int du, dv;
};

/// A way out of a gap.
struct GapEnd {
  float depth_m = 0.0F;
  int pixels = 0;  ///< without depth on the way to it
};

/// The first return from `pixel` on; empty if there is none within `reach_px` steps.
std::optional<GapEnd> endOf(const View& view, CameraModel::Pixel pixel, Step step, int reach_px) {
  const CameraModel& camera = view.camera();
  for (int i = 1; i <= reach_px; ++i) {
    const int u = pixel.u + i * step.du;
    const int v = pixel.v + i * step.dv;
    if (u < 0 || u >= camera.width() || v < 0 || v >= camera.height()) return std::nullopt;
    if (!view.tiles().isGap(u, v)) return GapEnd{camera.depth(view.rawAt(u, v)), i - 1};
  }
  return std::nullopt;
}

std::optional<float> narrowGapAlong(const View& view, CameraModel::Pixel pixel, Step step, int widest_px) {
  const auto ahead = endOf(view, pixel, step, widest_px);
  if (!ahead) return std::nullopt;
  const auto behind = endOf(view, pixel, {-step.du, -step.dv}, widest_px - ahead->pixels);
  if (!behind) return std::nullopt;
  return std::min(ahead->depth_m, behind->depth_m);
}

}  // namespace

std::optional<float> narrowGapDepth_m(const View& view, CameraModel::Pixel pixel, int widest_px) {
  const auto in_row = narrowGapAlong(view, pixel, {1, 0}, widest_px);
  const auto in_column = narrowGapAlong(view, pixel, {0, 1}, widest_px);
  if (in_row && in_column) return std::min(*in_row, *in_column);
  return in_row ? in_row : in_column;
}

}  // namespace nanomap
