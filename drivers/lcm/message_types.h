#pragma once

#include "bot_core/image_metadata_t.hpp"
#include "bot_core/image_t.hpp"
#include "bot_core/images_t.hpp"
#include "bot_core/planar_lidar_t.hpp"
#include "bot_core/pose_t.hpp"
#include "bot_core/rigid_transform_t.hpp"
#include "bot_core/utime_t.hpp"
#include "nanomap/answer_t.hpp"
#include "nanomap/answers_t.hpp"
#include "nanomap/body_pose_t.hpp"
#include "nanomap/camera_model_t.hpp"
#include "nanomap/counter_t.hpp"
#include "nanomap/decision_t.hpp"
#include "nanomap/depth_image_t.hpp"
#include "nanomap/goal_t.hpp"
#include "nanomap/health_t.hpp"
#include "nanomap/latency_t.hpp"
#include "nanomap/lost_t.hpp"
#include "nanomap/pose_correction_t.hpp"
#include "nanomap/setpoint_t.hpp"
#include "nanomap/stamped_transform_t.hpp"
#include "nanomap/step_t.hpp"
#include "nanomap/text_t.hpp"
#include "nanomap/trajectory_t.hpp"
#include "nanomap/transform_t.hpp"

/// Applies APPLY(Type) to every type of lcm_types.
#define NANOMAP_FOR_EACH_MESSAGE_TYPE(APPLY) \
  APPLY(bot_core::image_metadata_t)          \
  APPLY(bot_core::image_t)                   \
  APPLY(bot_core::images_t)                  \
  APPLY(bot_core::planar_lidar_t)            \
  APPLY(bot_core::pose_t)                    \
  APPLY(bot_core::rigid_transform_t)         \
  APPLY(bot_core::utime_t)                   \
  APPLY(nanomap::answer_t)                   \
  APPLY(nanomap::answers_t)                  \
  APPLY(nanomap::body_pose_t)                \
  APPLY(nanomap::camera_model_t)             \
  APPLY(nanomap::counter_t)                  \
  APPLY(nanomap::decision_t)                 \
  APPLY(nanomap::depth_image_t)              \
  APPLY(nanomap::goal_t)                     \
  APPLY(nanomap::health_t)                   \
  APPLY(nanomap::latency_t)                  \
  APPLY(nanomap::lost_t)                     \
  APPLY(nanomap::pose_correction_t)          \
  APPLY(nanomap::setpoint_t)                 \
  APPLY(nanomap::stamped_transform_t)        \
  APPLY(nanomap::step_t)                     \
  APPLY(nanomap::text_t)                     \
  APPLY(nanomap::trajectory_t)               \
  APPLY(nanomap::transform_t)
