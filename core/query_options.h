#pragma once

#include <cstdint>

namespace nanomap {

/// What "in front of what was seen" is asked of.
enum class OcclusionTest : std::uint8_t {
  kMean,       ///< the mean's pixel, as in the paper (IV.A.2)
  kFootprint,  ///< also every return in the box's pixel footprint against the box's far face
};

struct QueryOptions {
  int k = 1;  ///< neighbours wanted, 1 .. kMaxNeighbours
  OcclusionTest occlusion = OcclusionTest::kMean;
  /// A view is to hold so much more around the box, on all sides [m]; 0 in the paper. Not negative.
  double margin_m = 0.0;
  int open_window_px = 32;           ///< reach, to all sides, of the window that tells sky from a hole
  double open_range_fraction = 0.7;  ///< returns beyond this part of the range do not speak against sky
  /// Reach of a second window, in metres beside the point: what is seen in it and is not this much farther away than
  /// the point may be a pane's frame, which close by lies outside of a window in pixels.
  double open_frame_m = 2.0;

  /// Also how much of the space around the point is known to be empty (core/certified_clearance.h): costs many times
  /// what the rest does.
  bool certify = false;
  /// A gap among the depths that is no wider hides nothing, to a certificate: at 320 pixels, what stereo leaves out
  /// beside something 2 m away. At most GapsOfTile::kWidest_px.
  int narrow_gap_px = 8;
  /// Standard deviations of the drift since a view, by which a certified radius is less: one, as in the box.
  double certify_sigmas = 1.0;
};

}  // namespace nanomap
