#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "core/view.h"
#include "tests/bench/frames/recorded_flight.h"
#include "tests/bench/references/nanoflann_index.h"

namespace nanomap::bench {

/// One frame, indexed in every way there is, and points to ask for.
struct IndexFixture {
  enum class References { kNone, kAll };

  /// The last frame of `flight`, which must outlive this.
  IndexFixture(const RecordedFlight& flight, std::size_t query_count, References wanted);

  struct Indexed {
    std::string name;
    std::unique_ptr<const NearestPointIndex> index;
  };
  struct PointSet {
    std::string name;
    std::vector<Vec3f> points_C;
  };

  std::shared_ptr<const CameraModel> camera;
  const DepthImage& image;
  View view;                        ///< ours
  std::vector<Indexed> references;  ///< flann15, then nanoflann with every leaf size
  std::array<PointSet, 2> sets;     ///< uniform in the frustum, along primitives
};

}  // namespace nanomap::bench
