#include "tools/simulation/route.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace nanomap::simulation {
namespace {

using Vec2 = Eigen::Vector2d;
using Cell = Eigen::Vector2i;

constexpr double kCell_m = 0.25;

/// Which cells of a level plane are too near to an obstacle.
class OccupancyGrid {
 public:
  OccupancyGrid(const Scene& scene, double altitude_m, double clearance_m)
      : origin_m_(scene.mission().region_W.min().head<2>()) {
    const Vec2 size_m = scene.mission().region_W.sizes().head<2>();
    size_ = (size_m / kCell_m).array().floor().cast<int>() + 1;
    occupied_.assign(static_cast<std::size_t>(size_.x()) * static_cast<std::size_t>(size_.y()), false);
    for (const Solid& solid : scene.obstacles()) mark(solid, altitude_m, clearance_m);
  }

  [[nodiscard]] std::size_t cellCount() const { return occupied_.size(); }
  [[nodiscard]] bool holds(const Cell& cell) const {
    return (cell.array() >= 0).all() && (cell.array() < size_.array()).all();
  }
  [[nodiscard]] std::size_t index(const Cell& cell) const {
    return static_cast<std::size_t>(cell.y()) * static_cast<std::size_t>(size_.x()) +
           static_cast<std::size_t>(cell.x());
  }
  [[nodiscard]] Cell cell(std::size_t index) const {
    const auto width = static_cast<std::size_t>(size_.x());
    return {static_cast<int>(index % width), static_cast<int>(index / width)};
  }
  [[nodiscard]] bool free(const Cell& cell) const { return holds(cell) && !occupied_[index(cell)]; }
  [[nodiscard]] Cell cellAt(const Vec2& position_m) const {
    return ((position_m - origin_m_) / kCell_m).array().round().cast<int>();
  }
  [[nodiscard]] Vec2 position(const Cell& cell) const { return origin_m_ + kCell_m * cell.cast<double>(); }

  /// Whether the straight line between two cells touches free cells only.
  [[nodiscard]] bool sees(const Cell& from, const Cell& to) const {
    const Vec2 span = (to - from).cast<double>();
    const int steps = 2 * static_cast<int>(std::ceil(span.norm()));
    for (int i = 1; i < steps; ++i) {
      if (!free((from.cast<double>() + span * i / steps).array().round().cast<int>())) return false;
    }
    return true;
  }

 private:
  void mark(const Solid& solid, double altitude_m, double clearance_m) {
    const Box3 reach_W = bounds(solid);
    if (reach_W.min().z() > altitude_m + clearance_m || reach_W.max().z() < altitude_m - clearance_m) return;
    const Vec2 margin_m = Vec2::Constant(clearance_m);
    const Cell low = cellAt(reach_W.min().head<2>() - margin_m).cwiseMax(0);
    const Cell high = cellAt(reach_W.max().head<2>() + margin_m).cwiseMin(size_ - Cell::Ones());
    for (int y = low.y(); y <= high.y(); ++y) {
      for (int x = low.x(); x <= high.x(); ++x) {
        const Vec2 position_m = position({x, y});
        if (signedDistance(solid, {position_m.x(), position_m.y(), altitude_m}) < clearance_m) {
          occupied_[index({x, y})] = true;
        }
      }
    }
  }

  Vec2 origin_m_;
  Cell size_;
  std::vector<bool> occupied_;
};

/// Fewest metres over the grid's eight neighbours, in cells; empty if the goal cannot be reached.
std::vector<Cell> shortestCells(const OccupancyGrid& grid, const Cell& start, const Cell& goal) {
  static const std::array<Cell, 8> kNeighbours = {Cell(1, 0), Cell(-1, 0), Cell(0, 1),  Cell(0, -1),
                                                  Cell(1, 1), Cell(1, -1), Cell(-1, 1), Cell(-1, -1)};
  if (!grid.free(start) || !grid.free(goal)) return {};
  const std::size_t goal_index = grid.index(goal);
  std::vector<double> cost(grid.cellCount(), std::numeric_limits<double>::infinity());
  std::vector<std::size_t> parent(grid.cellCount(), goal_index);
  using Entry = std::pair<double, std::size_t>;  // cost through the cell, cell: ties break by cell, always alike
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  cost[grid.index(start)] = 0.0;
  open.emplace((goal - start).cast<double>().norm(), grid.index(start));
  std::vector<bool> settled(grid.cellCount(), false);
  while (!open.empty() && !settled[goal_index]) {
    const std::size_t here = open.top().second;
    open.pop();
    if (settled[here]) continue;
    settled[here] = true;
    for (const Cell& step : kNeighbours) {
      const Cell next_cell = grid.cell(here) + step;
      if (!grid.free(next_cell)) continue;
      const std::size_t next = grid.index(next_cell);
      const double next_cost = cost[here] + step.cast<double>().norm();
      if (next_cost >= cost[next]) continue;
      cost[next] = next_cost;
      parent[next] = here;
      open.emplace(next_cost + (goal - next_cell).cast<double>().norm(), next);
    }
  }
  if (!settled[goal_index]) return {};
  std::vector<Cell> cells = {goal};
  while (cells.back() != start) cells.push_back(grid.cell(parent[grid.index(cells.back())]));
  std::reverse(cells.begin(), cells.end());
  return cells;
}

/// Leaves out every cell that the last one kept can see past.
std::vector<Cell> pullTaut(const OccupancyGrid& grid, const std::vector<Cell>& cells) {
  std::vector<Cell> corners = {cells.front()};
  for (std::size_t i = 1; i + 1 < cells.size(); ++i) {
    if (!grid.sees(corners.back(), cells[i + 1])) corners.push_back(cells[i]);
  }
  corners.push_back(cells.back());
  return corners;
}

}  // namespace

std::optional<std::vector<Vec2>> planRoute(const Scene& scene, double clearance_m) {
  const Mission& mission = scene.mission();
  const OccupancyGrid grid(scene, mission.start_W.z(), clearance_m);
  std::vector<Vec3> stops_W = mission.via_W;
  stops_W.push_back(mission.goal_W);
  std::vector<Vec2> route = {mission.start_W.head<2>()};
  for (const Vec3& stop_W : stops_W) {
    const std::vector<Cell> cells = shortestCells(grid, grid.cellAt(route.back()), grid.cellAt(stop_W.head<2>()));
    if (cells.empty()) return std::nullopt;
    const std::vector<Cell> corners = pullTaut(grid, cells);
    for (std::size_t i = 1; i + 1 < corners.size(); ++i) route.push_back(grid.position(corners[i]));
    route.emplace_back(stop_W.head<2>());
  }
  return route;
}

}  // namespace nanomap::simulation
