#include "tools/generate/sensed_flight.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <utility>

#include "nanomap/goal_t.hpp"
#include "tools/generate/arrival_queue.h"
#include "tools/simulation/random.h"
#include "tools/simulation/scene_catalogue.h"

namespace nanomap::generate {
namespace {

using simulation::derivedSeed;
using simulation::VehicleState;
using simulation::VioEstimate;

// The scene takes the seed as it is, so that it can be made again by its name and seed alone.
// Stream 1 draws the flight along a path.
constexpr std::uint32_t kSensorStream = 2;
constexpr std::uint32_t kVioStream = 3;

Duration wholeMicroseconds(Duration duration) {
  return std::chrono::duration_cast<std::chrono::microseconds>(duration);
}

/// Moments at a fixed rate, in whole microseconds and without accumulated rounding.
class Ticker {
 public:
  /// @param rate_hz  0: never
  Ticker(Time start, double rate_hz) : start_(start), rate_hz_(rate_hz) {}

  [[nodiscard]] Time next() const {
    if (rate_hz_ == 0.0) return Time::max();
    return start_ + wholeMicroseconds(fromSeconds(static_cast<double>(count_) / rate_hz_));
  }
  [[nodiscard]] std::uint64_t count() const { return count_; }
  void advance() { ++count_; }

 private:
  Time start_;
  double rate_hz_;
  std::uint64_t count_ = 0;
};

void require(bool holds, const char* name, double value, const char* rule) {
  if (holds) return;
  throw std::invalid_argument(std::string("flight log: ") + name + " is " + std::to_string(value) + ", must be " +
                              rule);
}

SensedFlightOptions checked(SensedFlightOptions options) {
  require(options.depth_hz > 0.0 && std::isfinite(options.depth_hz), "depth_hz", options.depth_hz, "positive");
  require(options.correction_hz >= 0.0 && std::isfinite(options.correction_hz), "correction_hz", options.correction_hz,
          "0 or more");
  require(options.jump_m >= 0.0 && std::isfinite(options.jump_m), "jump_m", options.jump_m, "0 or more");
  for (const auto& [latency, name] :
       {std::pair(options.depth_latency, "depth_latency"), std::pair(options.pose_latency, "pose_latency"),
        std::pair(options.correction_delay, "correction_delay")}) {
    require(latency >= Duration::zero(), name, toSeconds(latency), "0 or more");
  }
  require(options.goal_speed_m_s > 0.0 && std::isfinite(options.goal_speed_m_s), "goal_speed_m_s",
          options.goal_speed_m_s, "positive");
  return options;
}

/// One flight: the state that advances while it lasts.
class Sensing {
 public:
  Sensing(const SensedFlightOptions& options, const LcmParameters& channels, simulation::VioSimulator vio, Flyer& flyer)
      : options_(options), channels_(channels), vio_(std::move(vio)), flyer_(flyer) {}

  void addCamera(Time stamp) {
    queue_.add(channels_.camera_channel, stamp, toMessage(options_.camera, SensedFlight::kCameraName, stamp));
  }

  void addGoal(Time stamp, const simulation::Scene& scene, std::uint64_t sequence) {
    goal_t goal;
    goal.utime = utimeFromTime(stamp);
    goal.sequence = static_cast<std::int64_t>(sequence);
    goal.epoch = static_cast<std::int32_t>(vio_.epoch());
    Vec3::Map(goal.position) = scene.mission().goal_W;
    goal.top_speed = options_.goal_speed_m_s;
    queue_.add(channels_.goal_channel, stamp, goal);
  }

  /// @param told  or does the estimator keep it for itself?
  void addPose(Time stamp, const simulation::Scene& scene, bool told) {
    const VehicleState truth = flyer_.at(stamp);
    const VioEstimate estimate = vio_.estimate(stamp, truth);
    flyer_.onEstimate(estimate);
    const Time arrival = stamp + options_.pose_latency;
    BodyMotion motion{estimate.velocity_W_m_s, truth.angular_rate_B_rad_s, truth.acceleration_W_m_s2};
    if (told && options_.pose_type == PoseType::kBodyPose) {
      queue_.add(channels_.pose_channel, arrival, toMessage(estimate.pose, motion));
    } else if (told) {
      queue_.add(channels_.pose_channel, arrival, toPoseMessage(estimate.pose, channels_.pose_t_body));
    }
    motion.velocity_W_m_s = truth.velocity_W_m_s;
    BodyPose true_pose;
    true_pose.stamp = stamp;
    true_pose.T_W_B = truth.T_W_B;
    true_pose.sequence = estimate.pose.sequence;
    queue_.add(SensedFlight::kTruthChannel, arrival, toMessage(true_pose, motion));

    const Vec3& p_W = truth.T_W_B.translation_m;
    if (last_position_W_) summary_.flown_m += (p_W - *last_position_W_).norm();
    last_position_W_ = p_W;
    summary_.min_clearance_m = std::min(summary_.min_clearance_m, scene.distanceToNearestObstacle(p_W));
    summary_.final_error_m = (estimate.pose.T_W_B.translation_m - p_W).norm();
  }

  void addDepth(Time stamp, std::uint64_t sequence, const CameraModel& camera, const simulation::RayCaster& ray_caster,
                const simulation::DepthSensor& sensor) {
    const Pose T_W_C = flyer_.at(stamp).T_W_B * camera.parameters().T_B_C;
    const DepthImage image = sensor.measure(ray_caster.render(camera, T_W_C), stamp, sequence);
    pixels_ += image.pixels.size();
    returns_ += image.pixels.size() - static_cast<std::size_t>(std::count(image.pixels.begin(), image.pixels.end(), 0));
    queue_.add(channels_.depth_channel, stamp + options_.depth_latency,
               toMessage(image, SensedFlight::kCameraName, options_.compression));
  }

  void addCorrection(Time window_end) {
    const Time computed = window_end + options_.correction_delay;
    queue_.add(channels_.correction_channel, computed, toMessage(vio_.correct(), computed));
  }

  void jump(double distance_m) { vio_.jump(distance_m); }

  /// Everything that will be added from now on arrives at `time` or later.
  void deliverUntil(Time time) { queue_.deliverUntil(time, deliver()); }

  SensedFlightSummary finish() {
    queue_.deliverUntil(Time::max(), deliver());
    summary_.messages = queue_.counts();
    if (pixels_ > 0) summary_.depth_share = static_cast<double>(returns_) / static_cast<double>(pixels_);
    return summary_;
  }

 private:
  [[nodiscard]] ArrivalQueue::Deliver deliver() {
    return [this](const std::string& channel, Time arrival, Bytes message) {
      flyer_.onArrival(channel, arrival, message);
    };
  }

  const SensedFlightOptions& options_;
  const LcmParameters& channels_;
  simulation::VioSimulator vio_;
  Flyer& flyer_;
  ArrivalQueue queue_;
  SensedFlightSummary summary_{.messages = {}, .min_clearance_m = std::numeric_limits<double>::infinity()};
  std::optional<Vec3> last_position_W_;
  std::uint64_t pixels_ = 0;
  std::uint64_t returns_ = 0;
};

}  // namespace

SensedFlight::SensedFlight(SensedFlightOptions options)
    : options_(checked(std::move(options))),
      camera_(options_.camera),
      scene_(simulation::makeScene(options_.scene, options_.seed)),
      ray_caster_(scene_.mesh()),
      sensor_(camera_, options_.sensor, derivedSeed(options_.seed, kSensorStream)),
      vio_(options_.vio, derivedSeed(options_.seed, kVioStream)) {}

SensedFlightSummary SensedFlight::fly(const LcmParameters& channels, Time start, Duration duration,
                                      Flyer& flyer) const {
  constexpr double kAnnouncements_hz = 1.0;  // camera and goal, for who joins late
  const Time end = start + duration;
  Sensing sensing(options_, channels, vio_, flyer);
  Ticker announcements(start, kAnnouncements_hz);
  Ticker poses(start, 1.0 / toSeconds(options_.vio.period));
  Ticker images(start, options_.depth_hz);
  Ticker corrections(start, options_.correction_hz);
  corrections.advance();  // no window at the start
  Time jump = options_.jump_m > 0.0 ? start + duration / 2 : Time::max();
  for (;;) {
    const Time now = std::min({announcements.next(), poses.next(), images.next(), corrections.next()});
    if (now >= end) break;
    sensing.deliverUntil(now);
    if (flyer.isDone()) break;
    if (now >= jump) {
      sensing.jump(options_.jump_m);
      jump = Time::max();
    }
    const SensorFaults faults = flyer.faultsAt(now);
    if (faults.jump_m > 0.0) sensing.jump(faults.jump_m);
    if (announcements.next() == now) {
      sensing.addCamera(now);
      sensing.addGoal(now, scene_, announcements.count());
      announcements.advance();
    }
    if (poses.next() == now) {
      sensing.addPose(now, scene_, !faults.estimator_off);
      poses.advance();
    }
    if (images.next() == now) {
      if (!faults.camera_off) sensing.addDepth(now, images.count(), camera_, ray_caster_, sensor_);
      images.advance();
    }
    if (corrections.next() == now) {
      if (!faults.estimator_off) sensing.addCorrection(now);
      corrections.advance();
    }
  }
  return sensing.finish();
}

}  // namespace nanomap::generate
