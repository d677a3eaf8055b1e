#include "tools/sim/lockstep_flight.h"

#include <algorithm>

#include "tools/replay/text.h"

namespace nanomap::sim {

double LockstepFlight::flown_s() const { return flown.departure ? toSeconds(flown.end - *flown.departure) : 0.0; }

double LockstepFlight::meanSpeed_m_s() const { return flown_s() > 0.0 ? flown.flown_m / flown_s() : 0.0; }

LockstepFlight flyInLockstep(const Configuration& configuration, const generate::SensedFlight& flight,
                             Duration duration, const SensorFaultPlanParameters& faults,
                             const std::optional<std::filesystem::path>& recordings) {
  LockstepFlyer flyer(configuration, flight.scene(), generate::SensedFlight::kStart, {}, faults, recordings);
  LockstepFlight flown;
  flown.seed = flight.options().seed;
  flown.sensed = flight.fly(configuration.lcm, generate::SensedFlight::kStart, duration, flyer);
  flown.flown = flyer.summary();
  return flown;
}

std::string tableOf(const std::string& scene, const std::vector<LockstepFlight>& flights) {
  const auto count = [&](Outcome outcome) {
    return std::ranges::count_if(flights,
                                 [=](const LockstepFlight& flight) { return flight.flown.outcome == outcome; });
  };
  Text text;
  text.line("{:<10}{:>5}  {:<18}{:>7}{:>8}{:>10}{:>9}{:>13}{:>8}", "scene", "seed", "outcome", "s", "m", "mean m/s",
            "top m/s", "clearance m", "braked");
  for (const LockstepFlight& flight : flights) {
    const LockstepSummary& flown = flight.flown;
    text.line("{:<10}{:>5}  {:<18}{:>7.1f}{:>8.1f}{:>10.2f}{:>9.2f}{:>13.2f}{:>8}", scene, flight.seed,
              toString(flown.outcome), flight.flown_s(), flown.flown_m, flight.meanSpeed_m_s(), flown.top_speed_m_s,
              flown.min_clearance_m, flown.braked);
  }
  text.line("{} of {} at the goal, {} collisions", count(Outcome::kAtGoal), flights.size(), count(Outcome::kCollision));
  return text.take();
}

}  // namespace nanomap::sim
