#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/camera_model.h"
#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"
#include "drivers/lcm/convert.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/simulation/depth_sensor.h"
#include "tools/simulation/ray_caster.h"
#include "tools/simulation/scene.h"
#include "tools/simulation/vehicle_state.h"
#include "tools/simulation/vio.h"

namespace nanomap::generate {

enum class PoseType {
  kBodyPose,  ///< nanomap.body_pose_t
  kPose,      ///< bot_core.pose_t: no epoch, no increment covariance
};

/// A scene, and the sensors that are flown through it.
struct SensedFlightOptions {
  std::string scene = "forest";
  std::uint64_t seed = 1;
  double goal_speed_m_s = 8.0;  ///< top speed that comes with the goal

  CameraParameters camera;  ///< as in tools/generate/paper_camera.h, say
  double depth_hz = 30.0;
  Duration depth_latency = std::chrono::milliseconds(30);
  DepthCompression compression = DepthCompression::kBlosc;
  simulation::DepthSensorParameters sensor;

  simulation::VioParameters vio;
  Duration pose_latency = std::chrono::milliseconds(5);
  PoseType pose_type = PoseType::kBodyPose;
  double correction_hz = 0.0;                                  ///< 0: none
  Duration correction_delay = std::chrono::milliseconds(200);  ///< from the window's end to the message's arrival
  double jump_m = 0.0;                                         ///< how far the estimator's world jumps once; 0: not
};

/// What befalls the sensors at one moment.
struct SensorFaults {
  bool camera_off = false;
  bool estimator_off = false;  ///< tells neither poses nor corrections, but does not forget
  double jump_m = 0.0;         ///< the estimator's world jumps by so much now; 0: not
};

/// What was sensed.
struct SensedFlightSummary {
  std::map<std::string, std::uint64_t> messages;  ///< by channel
  double depth_share = 0.0;                       ///< of all pixels, those with a return
  double flown_m = 0.0;
  double min_clearance_m = 0.0;  ///< of the vehicle's centre to the nearest obstacle, over all poses
  double final_error_m = 0.0;    ///< of the last pose
};

/// Who flies while the sensors look. Stamps and arrivals never decrease.
class Flyer {
 public:
  Flyer() = default;
  Flyer(const Flyer&) = delete;
  Flyer& operator=(const Flyer&) = delete;
  virtual ~Flyer() = default;

  /// The vehicle's true state.
  [[nodiscard]] virtual simulation::VehicleState at(Time stamp) = 0;

  /// What the estimator makes of it, each time it does: the autopilot has it at once.
  virtual void onEstimate(const simulation::VioEstimate& /*estimate*/) {}

  /// A message, when it arrives.
  virtual void onArrival(const std::string& channel, Time arrival, Bytes message) = 0;

  /// Asked once for every moment at which a sensor is due.
  [[nodiscard]] virtual SensorFaults faultsAt(Time /*stamp*/) { return {}; }

  /// Nothing more is to be sensed.
  [[nodiscard]] virtual bool isDone() const { return false; }
};

/// What sensors and estimator say while a vehicle flies through a simulated scene: every message at the time it would
/// have arrived, in that order. The same options and the same flight give the same bytes.
/// Threads: one.
class SensedFlight {
 public:
  static constexpr const char* kTruthChannel = "TRUTH_POSE_BODY";
  static constexpr const char* kCameraName = "depth";
  /// Where a simulated timeline begins: even a short flight crosses a second boundary.
  static constexpr Time kStart = timeFromNanoseconds(1'700'000'000'650'000'000);

  /// @throws std::exception with a message that names the option at fault
  explicit SensedFlight(SensedFlightOptions options);
  SensedFlight(const SensedFlight&) = delete;
  SensedFlight& operator=(const SensedFlight&) = delete;

  [[nodiscard]] const SensedFlightOptions& options() const { return options_; }
  [[nodiscard]] const simulation::Scene& scene() const { return scene_; }

  /// Flies for `duration`, or until the flyer is done. The estimator's world jumps halfway through `duration`.
  /// @param start  a whole microsecond
  /// @throws what the flyer throws
  SensedFlightSummary fly(const LcmParameters& channels, Time start, Duration duration, Flyer& flyer) const;

 private:
  SensedFlightOptions options_;
  CameraModel camera_;
  simulation::Scene scene_;
  simulation::RayCaster ray_caster_;
  simulation::DepthSensor sensor_;  ///< of camera_
  simulation::VioSimulator vio_;    ///< as it starts
};

}  // namespace nanomap::generate
