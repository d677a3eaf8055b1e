#pragma once

#include <optional>

#include "core/camera_model.h"
#include "core/view.h"

namespace nanomap {

/// A pixel without depth lies in a gap of its row and in one of its column. If one of the two is at most `widest_px`
/// pixels wide and has a return at either end, this is the nearest of its ends, or of both gaps' ends [m]: nothing
/// wider hides in it in front of them. Empty if both gaps are wider, or reach the image's border.
/// Allocates: no. Threads: any number of readers.
[[nodiscard]] std::optional<float> narrowGapDepth_m(const View& view, CameraModel::Pixel pixel, int widest_px);

}  // namespace nanomap
