#include "tests/bench/references/linear_scan.h"

#include <algorithm>
#include <cmath>

namespace nanomap::bench {

std::vector<float> nearestDistances(std::span<const Vec3f> points_C, const Vec3f& p_C, std::size_t count) {
  std::vector<float> squares_m2;
  squares_m2.reserve(points_C.size());
  for (const Vec3f& point_C : points_C) {
    const float dx = p_C.x() - point_C.x();
    const float dy = p_C.y() - point_C.y();
    const float dz = p_C.z() - point_C.z();
    squares_m2.push_back(dx * dx + dy * dy + dz * dz);
  }
  const auto end = squares_m2.begin() + static_cast<std::ptrdiff_t>(std::min(count, squares_m2.size()));
  if (end != squares_m2.end()) std::nth_element(squares_m2.begin(), end, squares_m2.end());
  squares_m2.erase(end, squares_m2.end());
  std::sort(squares_m2.begin(), squares_m2.end());
  for (float& square_m2 : squares_m2) square_m2 = std::sqrt(square_m2);
  return squares_m2;
}

}  // namespace nanomap::bench
