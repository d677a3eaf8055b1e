#include "tools/sim/scene_placement.h"

#include <cmath>

namespace nanomap::sim {

NedFromWorld placeScene(const simulation::Mission& mission, const AutopilotPose& vehicle, bool on_ground,
                        double heading_rad) {
  const Vec3 way_W = mission.goal_W - mission.start_W;
  const double world_heading_rad = heading_rad + std::atan2(way_W.y(), way_W.x());
  const double height_m = on_ground ? 0.0 : -vehicle.position_NED_m.z();
  const Vec3 vehicle_W(mission.start_W.x(), mission.start_W.y(), height_m);
  return {world_heading_rad,
          vehicle.position_NED_m - NedFromWorld(world_heading_rad, Vec3::Zero()).direction(vehicle_W)};
}

}  // namespace nanomap::sim
