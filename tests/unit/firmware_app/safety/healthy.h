#pragma once

#include "firmware_app/safety/state_machine.h"

namespace nanomap {

inline constexpr Duration kStep = std::chrono::milliseconds(20);

inline Time atMs(std::int64_t ms) { return Time(std::chrono::milliseconds(ms)); }

/// A situation in which nothing is missing, with the vehicle in the pilot's hands, in the air.
inline Situation healthyAt(Time now) {
  Situation situation;
  situation.now = now;
  situation.camera = true;
  situation.depth = now - std::chrono::milliseconds(60);
  situation.pose = now - std::chrono::milliseconds(10);
  situation.plan = now - std::chrono::milliseconds(30);
  situation.brake_end = now + std::chrono::milliseconds(900);
  situation.speed_m_s = 5.0;
  situation.anchored = true;
  situation.motion_anchored = true;
  situation.linked = true;
  situation.armed = true;
  return situation;
}

/// The same after the pilot's switch.
inline Situation orderedAt(Time now) {
  Situation situation = healthyAt(now);
  situation.external_control = true;
  situation.external_control_entries = 1;
  return situation;
}

}  // namespace nanomap
