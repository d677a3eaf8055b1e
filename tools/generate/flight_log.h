#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/camera_model.h"
#include "core/time.h"
#include "drivers/lcm/convert.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/flight_path.h"
#include "tools/simulation/ray_caster.h"
#include "tools/simulation/scene.h"
#include "tools/simulation/vio.h"

namespace nanomap::generate {

enum class PoseType {
  kBodyPose,  ///< nanomap.body_pose_t
  kPose,      ///< bot_core.pose_t: no epoch, no increment covariance
};

struct FlightLogOptions {
  std::string scene = "forest";
  std::uint64_t seed = 1;
  std::optional<Duration> duration;                             ///< empty: until the vehicle stands at the goal
  Time start = timeFromNanoseconds(1'700'000'000'650'000'000);  ///< so that even a short log crosses a second boundary

  CameraParameters camera;  ///< as in tools/generate/paper_camera.h, say
  double depth_hz = 30.0;
  Duration depth_latency = std::chrono::milliseconds(30);
  DepthCompression compression = DepthCompression::kBlosc;
  simulation::DepthSensorParameters sensor;

  simulation::FlightParameters flight;
  simulation::VioParameters vio;
  Duration pose_latency = std::chrono::milliseconds(5);
  PoseType pose_type = PoseType::kBodyPose;
  double correction_hz = 0.0;                                  ///< 0: none
  Duration correction_delay = std::chrono::milliseconds(200);  ///< from the window's end to the message's arrival
  double jump_m = 0.0;  ///< how far the estimator's world jumps halfway through the log; 0: not at all
};

/// What was written.
struct FlightLogSummary {
  std::map<std::string, std::uint64_t> messages;  ///< by channel
  double depth_share = 0.0;                       ///< of all pixels, those with a return
  double flown_m = 0.0;
  double min_clearance_m = 0.0;  ///< of the vehicle's centre to the nearest obstacle, over all poses
  double final_error_m = 0.0;    ///< of the last pose
};

/// A flight through a simulated scene as a log would have recorded it: every message at the time it would have arrived,
/// in that order. The same options write the same bytes.
/// Threads: one.
class FlightLog {
 public:
  static constexpr const char* kTruthChannel = "TRUTH_POSE_BODY";
  static constexpr const char* kCameraName = "depth";

  /// Builds the scene and finds a way through it.
  /// @throws std::exception with a message that names the option at fault
  explicit FlightLog(FlightLogOptions options);
  FlightLog(const FlightLog&) = delete;
  FlightLog& operator=(const FlightLog&) = delete;

  [[nodiscard]] const simulation::Scene& scene() const { return scene_; }
  [[nodiscard]] Duration duration() const { return duration_; }

  /// @throws LogError if the log cannot be written
  FlightLogSummary write(const LcmParameters& channels, LogWriter& log) const;

 private:
  FlightLogOptions options_;
  CameraModel camera_;
  simulation::Scene scene_;
  simulation::FlightPath path_;
  simulation::RayCaster ray_caster_;
  simulation::DepthSensor sensor_;  ///< of camera_
  simulation::VioSimulator vio_;    ///< as it starts
  Duration duration_;
};

}  // namespace nanomap::generate
