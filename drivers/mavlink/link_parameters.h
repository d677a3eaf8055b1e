#pragma once

#include <cstdint>
#include <string>

#include "core/time.h"

namespace nanomap {

struct LinkParameters {
  /// As MAVSDK takes it: udpin://0.0.0.0:14540, udpout://host:port, tcpout://host:port, serial:///dev/ttyACM0:921600
  std::string url = "udpin://0.0.0.0:14540";
  /// The vehicle's: a companion computer is a part of it. Another vehicle's autopilot gets no setpoint.
  std::uint8_t system_id = 1;
  std::uint8_t component_id = 196;  ///< MAV_COMP_ID_OBSTACLE_AVOIDANCE
  Duration heartbeat_timeout = std::chrono::seconds(3);
  double pose_rate_hz = 50.0;  ///< of the position and attitude that the autopilot is asked to stream
};

}  // namespace nanomap
