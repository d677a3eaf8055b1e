#include "planner/retreat.h"

#include <utility>

namespace nanomap {
namespace {

/// Of what index and query measure a distance in: single precision at some metres.
constexpr double kRounding_m = 1e-4;

/// Seen as free first, then far away.
std::pair<bool, double> worth(const TrajectoryRisk& brake) {
  return {endsSearch(brake.last.status), brake.last.distance_m()};
}

}  // namespace

std::optional<Retreat> chooseRetreat(const Candidates& candidates, double least_gain_m, double max_prior) {
  std::optional<Retreat> best;
  for (std::uint32_t index = 0; index < kBrake; ++index) {
    const TrajectoryRisk brake = candidates.assessBrake(index);
    const double start_m = brake.first.distance_m();
    const double end_m = brake.last.distance_m();
    const bool leads_away = brake.least_distance_m >= start_m - kRounding_m && end_m >= start_m + least_gain_m;
    if (!leads_away || !brake.last.seenFree() || brake.largest_prior > max_prior) continue;
    if (!best || worth(brake) > worth(best->brake)) best = Retreat{index, brake};
  }
  return best;
}

}  // namespace nanomap
