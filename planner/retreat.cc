#include "planner/retreat.h"

#include <algorithm>
#include <tuple>

namespace nanomap {
namespace {

/// Of what index and query measure a distance in: single precision at some metres.
constexpr double kRounding_m = 1e-4;

/// A way out is looked for step by step. Faster than that when its brake begins, a vehicle flies on past what is near,
/// and plan after plan puts off the stop.
constexpr double kStep_m_s = 0.5;

/// Half the odds: less of a difference is not worth a motion, a plan later it may be the other way round.
bool isMuchLess(double risk, double other_risk) { return 2.0 * risk * (1.0 - other_risk) < other_risk * (1.0 - risk); }

bool leadsAway(const TrajectoryRisk& brake, double least_gain_m) {
  const double start_m = brake.first.distance_m();
  return brake.least_distance_m >= start_m - kRounding_m && brake.last.distance_m() >= start_m + least_gain_m;
}

/// Than stopping.
bool isSafer(const TrajectoryRisk& brake, const TrajectoryRisk& stop, double least_gain_m) {
  const bool no_more = brake.risk <= stop.risk && brake.last.risk <= stop.last.risk;
  return no_more && (isMuchLess(brake.last.risk, stop.last.risk) || leadsAway(brake, least_gain_m));
}

bool isKnown(const TrajectoryRisk& brake, double max_risk) {
  return brake.last.seenFree() && brake.largest_prior <= max_risk;
}

/// Seen as free first, then little risk on the way, at its end, and then far away.
std::tuple<bool, double, double, double> worth(const TrajectoryRisk& brake) {
  return {endsSearch(brake.last.status), -brake.risk, -brake.last.risk, brake.last.distance_m()};
}

/// Stopping at once, or as what is in force does.
Retreat bestStop(const Candidates& candidates, double max_risk) {
  const Retreat at_once{kBrake, candidates.assessBrake(kBrake)};
  if (candidates.count() <= kBrakeInForce) return at_once;
  const Retreat in_force{kBrakeInForce, candidates.assessBrake(kBrakeInForce)};
  if (!isKnown(in_force.brake, max_risk)) return at_once;
  const bool is_better = !isKnown(at_once.brake, max_risk) || worth(in_force.brake) > worth(at_once.brake);
  return is_better ? in_force : at_once;
}

}  // namespace

std::optional<Retreat> chooseRetreat(const Candidates& candidates, const PlannerParameters& parameters) {
  const double max_risk = parameters.risk.max_risk;
  const Retreat stop = bestStop(candidates, max_risk);
  std::optional<Retreat> best;
  for (std::uint32_t index = 0; index < kBrake; ++index) {
    const Motion at_braking = candidates.brake(index).sample(parameters.brake_after_s);
    if (at_braking.velocity_m_s.norm() > kStep_m_s) continue;
    const TrajectoryRisk brake = candidates.assessBrake(index);
    if (!isKnown(brake, max_risk) || !isSafer(brake, stop.brake, parameters.objective.least_gain_m)) continue;
    if (!best || worth(brake) > worth(best->brake)) best = Retreat{index, brake};
  }
  if (!best && isKnown(stop.brake, max_risk)) best = stop;
  return best;
}

}  // namespace nanomap
