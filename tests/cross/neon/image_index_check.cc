// Compares the nearest-point index with brute force on the processor that it runs on. Prints what differs; returns 1 if
// anything does. Without a test library, of which there is none for every processor.
#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <random>
#include <vector>

#include "core/image_index.h"
#include "tests/support/camera.h"
#include "tests/support/drawing.h"
#include "tests/support/nearest_oracle.h"

namespace nanomap {
namespace {

constexpr unsigned kSeed = 7;
constexpr int kQueries = 40;
constexpr float kReach_m = 12.0F;

/// @return how many answers around one point differ
int mismatches(const ImageIndex& index, const std::vector<Vec3f>& points_C, const Vec3f& p_C) {
  int count = 0;
  const std::vector<float> expected_m = test::bruteForce(points_C, p_C);
  for (const std::size_t k : {1U, 2U, 10U, 16U}) {
    std::array<Neighbour, kMaxNeighbours> found;
    const std::size_t found_count = index.nearest(p_C, std::span(found).first(k));
    bool same = found_count == std::min(k, expected_m.size());
    for (std::size_t i = 0; same && i < found_count; ++i) {
      same = found[i].distance_m == expected_m[i] && test::bruteForce({found[i].point_C}, p_C).front() == expected_m[i];
    }
    if (same) continue;
    ++count;
    std::printf("k %zu at (%g, %g, %g): found %zu, first at %.9g m, not %.9g m\n", k, static_cast<double>(p_C.x()),
                static_cast<double>(p_C.y()), static_cast<double>(p_C.z()), found_count,
                static_cast<double>(found[0].distance_m),
                static_cast<double>(expected_m.empty() ? NAN : expected_m.front()));
  }
  return count;
}

/// @return how many answers differ for images of one camera
int mismatches(const CameraParameters& parameters, std::mt19937& random) {
  const auto camera = test::model(parameters);
  TiledImage tiles({camera->width(), camera->height()});
  ImageIndex index(camera, tiles);
  std::uniform_real_distribution<float> coordinate_m(-kReach_m, kReach_m);
  int count = 0;
  for (const double no_return_share : {0.0, 0.3, 0.99, 1.0}) {
    for (const std::uint16_t farthest : {std::uint16_t{151}, std::uint16_t{500}, std::uint16_t{9900}}) {
      const DepthImage image = test::randomImage(*camera, random, 150, farthest, no_return_share);
      index.build(image.pixels);
      const std::vector<Vec3f> points_C = test::pointsInRange(image, *camera);
      for (int i = 0; i < kQueries; ++i) {
        count += mismatches(index, points_C, {coordinate_m(random), coordinate_m(random), coordinate_m(random)});
      }
    }
  }
  return count;
}

}  // namespace
}  // namespace nanomap

int main() {
  std::mt19937 random(nanomap::kSeed);
  int count = 0;
  for (const auto& [width_px, height_px] : {std::pair(97, 61), {64, 48}, {5, 70}, {1, 1}}) {
    nanomap::CameraParameters camera = nanomap::test::smallCamera(width_px, height_px);
    camera.min_range_m = 0.15;
    count += nanomap::mismatches(camera, random);
    camera.fx_px = camera.fy_px = std::max(width_px, height_px) / 1.5;
    camera.distortion = {-0.15, 0.04, 0.003, -0.002, 0.0};
    count += nanomap::mismatches(camera, random);
  }
  std::printf("%d answers differ from brute force\n", count);
  return count == 0 ? 0 : 1;
}
