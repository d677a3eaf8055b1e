#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/frames/generated_scene.h"

namespace nanomap::bench {

/// What answers are worth against the scene's true clearance, for one set of points. Shares are 0 .. 1.
struct CertifiedFigures {
  /// Share of points that a distance is said of which is above the truth by more than so much.
  struct Over {
    double by_0_1_m = 0.0;
    double by_0_5_m = 0.0;
  };

  std::string where;           ///< scene and set of points
  std::size_t points = 0;      ///< answered with kFree or kOpen: the others are no place to be anyway
  Over nearest;                ///< of the nearest neighbour in the view that answers
  Over certified;              ///< of the certified radius
  double median = 0.0;         ///< certified / true clearance where anything is certified
  double median_of_all = 0.0;  ///< the same with zeros for the others
  double unanswered = 0.0;     ///< share that nothing is certified of
  double cost = 0.0;           ///< time of a query with certificate / without
};

/// How far is looked for neighbours, and up to which radius certified: what a planner wants to know of a place. True
/// clearance beyond it counts as this much.
inline constexpr double kSurveyReach_m = 3.0;

/// Flies through a scene with a pose estimate that drifts as the chain assumes, and asks at the end for `count` points
/// in the newest view's frustum and as many within `kSurveyReach_m` of the vehicle. The same every time, but for the
/// cost.
/// @throws std::exception naming the scene, if it is unknown
[[nodiscard]] std::vector<CertifiedFigures> surveyCertificates(std::string_view scene, Noise noise, std::size_t history,
                                                               std::size_t count);

/// One line for each, below the names of the columns.
void print(const std::vector<CertifiedFigures>& figures);

}  // namespace nanomap::bench
