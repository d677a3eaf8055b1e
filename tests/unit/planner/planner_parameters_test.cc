#include "planner/planner_parameters.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <stdexcept>

#include "planner/planner.h"

namespace nanomap {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(PlannerParameters, DefaultsAreValid) { EXPECT_NO_THROW(Planner(PlannerParameters{})); }

TEST(PlannerParameters, VehiclesMayBeTakenToBeWhereTheyShouldBe) {
  PlannerParameters parameters;
  parameters.tracking.recovery_s = 0.0;
  EXPECT_NO_THROW(Planner{parameters});
}

TEST(PlannerParameters, ABadOneIsNamed) {
  struct Case {
    const char* name;
    std::function<void(PlannerParameters&)> spoil;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
      {"limits.horizontal_at_rest_m_s2", [](auto& p) { p.limits.horizontal_at_rest_m_s2 = 0.0; }},
      {"limits.horizontal_at_full_m_s2", [](auto& p) { p.limits.horizontal_at_full_m_s2 = 1.0; }},
      {"limits.top_speed_m_s", [](auto& p) { p.limits.top_speed_m_s = 0.0; }},
      {"limits.vertical_m_s2", [&](auto& p) { p.limits.vertical_m_s2 = nan; }},
      {"limits.ramp_s", [](auto& p) { p.limits.ramp_s = -0.2; }},
      {"limits.jerk_m_s3", [](auto& p) { p.limits.jerk_m_s3 = 0.0; }},
      {"horizon.push_s", [](auto& p) { p.horizon.push_s = 0.2; }},
      {"horizon.max_s", [](auto& p) { p.horizon.max_s = 0.5; }},
      {"objective.max_altitude_W_m", [](auto& p) { p.objective.max_altitude_W_m = -1.0; }},
      {"objective.least_gain_m", [](auto& p) { p.objective.least_gain_m = 1.0; }},
      {"risk.max_risk", [](auto& p) { p.risk.max_risk = 1.5; }},
      {"risk.query.k", [](auto& p) { p.risk.query.k = 0; }},
      {"risk.query.k", [](auto& p) { p.risk.query.k = kMaxNeighbours + 1; }},
      {"risk.prior of 'hole'", [](auto& p) { p.risk.prior[static_cast<std::size_t>(Status::kHole)] = -0.1; }},
      {"risk.collision.vehicle_radius_m", [](auto& p) { p.risk.collision.vehicle_radius_m = 0.0; }},
      {"risk.horizontal.base_m", [&](auto& p) { p.risk.horizontal.base_m = nan; }},
      {"heading.max_rate_rad_s", [](auto& p) { p.heading.max_rate_rad_s = 0.1; }},
      {"heading.sweep_amplitude_rad", [](auto& p) { p.heading.sweep_amplitude_rad = 0.0; }},
      {"tracking.recovery_s", [](auto& p) { p.tracking.recovery_s = 0.4; }},
      {"tracking.recovery_s", [&](auto& p) { p.tracking.recovery_s = nan; }},
      {"brake_after_s", [](auto& p) { p.brake_after_s = 0.0; }},
      {"samples", [](auto& p) { p.samples = 0; }},
      {"brake_samples", [](auto& p) { p.brake_samples = 0; }},
      {"max_state_age", [](auto& p) { p.max_state_age = Duration::zero(); }},
  };
  for (const Case& bad : cases) {
    PlannerParameters parameters;
    bad.spoil(parameters);
    EXPECT_THAT([&] { Planner planner(parameters); }, ThrowsMessage<std::invalid_argument>(HasSubstr(bad.name)));
  }
}

}  // namespace
}  // namespace nanomap
