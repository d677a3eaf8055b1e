#include "tests/bench/rows/index_fixture.h"

#include "core/flann_index.h"
#include "tests/bench/points/camera_points.h"

namespace nanomap::bench {

IndexFixture::IndexFixture(const RecordedFlight& flight, std::size_t query_count, References wanted)
    : camera(flight.camera),
      image(flight.frames.back()),
      view(flight.camera, IndexKind::kImage),
      sets{PointSet{"uniform", uniformPoints(image, *camera, query_count)},
           PointSet{"primitives", primitivePoints(image, *camera, query_count)}} {
  view.assign(image);
  if (wanted == References::kNone) return;
  references.push_back({"flann15", buildFlannIndex(image, *camera)});
  for (const int leaf : kNanoflannLeaves) {
    references.push_back({"nanoflann" + std::to_string(leaf), buildNanoflannIndex(image, *camera, leaf)});
  }
}

}  // namespace nanomap::bench
