#include "tools/sim/blindness.h"

namespace nanomap::sim {

std::vector<std::string> blindToObstacles() {
  return {"planner.stop_check=\"paper\"",
          "risk.max_risk=1",
          "vehicle.radius_m=0.01",
          "risk.horizontal_base_m=0",
          "risk.horizontal_per_speed_s=0",
          "risk.horizontal_per_time_m_s=0",
          "risk.vertical_base_m=0",
          "risk.vertical_per_speed_s=0",
          "risk.vertical_per_time_m_s=0",
          "risk.prior_occluded=0",
          "risk.prior_partial=0",
          "risk.prior_hole=0",
          "risk.prior_outside_fov=0",
          "risk.prior_beyond_range=0",
          "risk.prior_behind=0"};
}

}  // namespace nanomap::sim
