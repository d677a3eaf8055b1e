#pragma once

#include <optional>
#include <string>

#include "core/camera_model.h"
#include "core/chain.h"
#include "core/query.h"
#include "drivers/lcm/body_convention.h"

namespace nanomap {

/// The vehicle's own size.
struct VehicleParameters {
  double radius_m = 0.4;         ///< of the sphere around the body's origin that holds all of it
  double bubble_margin_m = 0.4;  ///< beyond the radius: nearer than that no view's absence of data counts
};

/// Names and habits of the LCM network, live or in a log.
struct LcmParameters {
  std::string depth_channel = "DEPTH";
  std::string pose_channel = "POSE_BODY";
  std::string correction_channel = "POSE_CORRECTION";
  std::string camera_channel = "CAMERA";
  std::string goal_channel = "GOAL";
  std::string answers_channel = "NANOMAP_ANSWERS";
  BodyConvention pose_t_body = BodyConvention::kFlu;  ///< of bot_core.pose_t, which does not say
  double max_body_speed_m_s = 30.0;  ///< a faster step between poses without epochs is a jump of the world; 0: never
};

/// Everything that one file configures. Plain values: the sections of the file map to them one by one
/// (firmware_app/configuration/sections.h), and their initialisers are the file's defaults.
struct Configuration {
  std::optional<CameraParameters> camera;  ///< empty: as the camera's own message says
  VehicleParameters vehicle;
  ChainParameters chain;  ///< [history] and [drift]
  QueryOptions query;
  LcmParameters lcm;
};

}  // namespace nanomap
