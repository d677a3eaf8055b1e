#pragma once

#include <memory>
#include <vector>

#include "tests/bench/frames/generated_scene.h"
#include "tests/bench/report/contest.h"
#include "tests/bench/rows/index_fixture.h"

namespace nanomap::bench {

/// From the 16-bit image to an index that answers; ours brings the image and its tiles into their final form as well.
[[nodiscard]] Contest buildContest(std::shared_ptr<const IndexFixture> fixture);

/// Nearest neighbours of single points: k = 1, k = 10, and k = 1 within 1 m, for each set of points.
[[nodiscard]] std::vector<Contest> nearestContests(std::shared_ptr<const IndexFixture> fixture, Noise noise);

/// Ours against ours: a large image against a small one, by query and by pixel.
[[nodiscard]] std::vector<Contest> sizeContests(std::shared_ptr<const IndexFixture> small,
                                                std::shared_ptr<const IndexFixture> large);

}  // namespace nanomap::bench
