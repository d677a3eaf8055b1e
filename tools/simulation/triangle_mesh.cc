#include "tools/simulation/triangle_mesh.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace nanomap::simulation {
namespace {

using std::numbers::pi;

constexpr std::array<std::array<double, 2>, 4> kSquareCorners = {{{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}}};

/// Corners of the regular polygon inside a circle whose edges stay within `tolerance_m` of it.
std::uint32_t polygonSides(double radius_m, double tolerance_m) {
  constexpr double kFewest = 6.0;
  const double half_angle_rad = std::acos(std::max(1.0 - tolerance_m / radius_m, 0.0));
  return static_cast<std::uint32_t>(std::max(std::ceil(pi / half_angle_rad), kFewest));
}

struct Appender {
  TriangleMesh& mesh;

  std::uint32_t addVertex(const Vec3& p_W) const {
    mesh.vertices_W.push_back(p_W.cast<float>());
    return static_cast<std::uint32_t>(mesh.vertices_W.size() - 1);
  }

  void addQuad(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) const {
    mesh.triangles.push_back({a, b, c});
    mesh.triangles.push_back({a, c, d});
  }

  void operator()(const UprightBox& box) const {
    const Eigen::AngleAxisd R_W_box(box.yaw_rad, Vec3::UnitZ());
    const auto first = static_cast<std::uint32_t>(mesh.vertices_W.size());
    for (const double z : {-1.0, 1.0}) {
      for (const auto& [x, y] : kSquareCorners) {
        addVertex(box.center_W + R_W_box * box.half_size_m.cwiseProduct(Vec3(x, y, z)));
      }
    }
    addQuad(first, first + 1, first + 2, first + 3);
    addQuad(first + 4, first + 5, first + 6, first + 7);
    for (std::uint32_t i = 0; i < 4; ++i) {
      const std::uint32_t next = (i + 1) % 4;
      addQuad(first + i, first + next, first + 4 + next, first + 4 + i);
    }
  }

  void operator()(const Cylinder& cylinder) const {
    const Vec3 axis = (cylinder.top_W - cylinder.base_W).normalized();
    const Vec3 across = axis.unitOrthogonal();
    const Vec3 up = axis.cross(across);
    const std::uint32_t sides = polygonSides(cylinder.radius_m, kCylinderTolerance_m);
    const std::uint32_t base = addVertex(cylinder.base_W);
    const std::uint32_t top = addVertex(cylinder.top_W);
    for (std::uint32_t i = 0; i < sides; ++i) {
      const double angle_rad = 2.0 * pi * i / sides;
      const Vec3 rim_m = cylinder.radius_m * (std::cos(angle_rad) * across + std::sin(angle_rad) * up);
      addVertex(cylinder.base_W + rim_m);
      addVertex(cylinder.top_W + rim_m);
    }
    const std::uint32_t rim = top + 1;
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t here = rim + 2 * i;
      const std::uint32_t next = rim + 2 * ((i + 1) % sides);
      addQuad(here, next, next + 1, here + 1);
      mesh.triangles.push_back({base, here, next});
      mesh.triangles.push_back({top, here + 1, next + 1});
    }
  }

  void operator()(const Sphere& sphere) const {
    // Facets are flat in both directions, and each takes its share of the tolerance.
    const std::uint32_t sides = polygonSides(sphere.radius_m, kSphereTolerance_m / 2.0);
    const std::uint32_t rings = (sides + 1) / 2;
    const std::uint32_t south = addVertex(sphere.center_W - sphere.radius_m * Vec3::UnitZ());
    const std::uint32_t north = addVertex(sphere.center_W + sphere.radius_m * Vec3::UnitZ());
    const std::uint32_t first = north + 1;
    for (std::uint32_t ring = 1; ring < rings; ++ring) {
      const double latitude_rad = pi * ring / rings - pi / 2.0;
      for (std::uint32_t i = 0; i < sides; ++i) {
        const double longitude_rad = 2.0 * pi * i / sides;
        addVertex(sphere.center_W + sphere.radius_m * Vec3(std::cos(latitude_rad) * std::cos(longitude_rad),
                                                           std::cos(latitude_rad) * std::sin(longitude_rad),
                                                           std::sin(latitude_rad)));
      }
    }
    for (std::uint32_t i = 0; i < sides; ++i) {
      const std::uint32_t next = (i + 1) % sides;
      for (std::uint32_t ring = 0; ring + 2 < rings; ++ring) {
        const std::uint32_t lower = first + ring * sides;
        addQuad(lower + i, lower + next, lower + sides + next, lower + sides + i);
      }
      const std::uint32_t last = first + (rings - 2) * sides;
      mesh.triangles.push_back({south, first + i, first + next});
      mesh.triangles.push_back({north, last + i, last + next});
    }
  }
};

}  // namespace

void append(const Solid& solid, TriangleMesh& mesh) { std::visit(Appender{mesh}, solid); }

void appendGround(const Box3& area_W, TriangleMesh& mesh) {
  const Appender appender{mesh};
  const std::uint32_t first = appender.addVertex({area_W.min().x(), area_W.min().y(), 0.0});
  appender.addVertex({area_W.max().x(), area_W.min().y(), 0.0});
  appender.addVertex({area_W.max().x(), area_W.max().y(), 0.0});
  appender.addVertex({area_W.min().x(), area_W.max().y(), 0.0});
  appender.addQuad(first, first + 1, first + 2, first + 3);
}

}  // namespace nanomap::simulation
