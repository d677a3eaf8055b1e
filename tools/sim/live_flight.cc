#include "tools/sim/live_flight.h"

#include <fmt/format.h>

#include <numbers>
#include <stdexcept>
#include <thread>
#include <utility>

#include "drivers/lcm/lcm_network.h"
#include "drivers/mavlink/mavlink_link.h"
#include "drivers/mavlink/mavsdk_log.h"
#include "drivers/recording/log_source.h"
#include "tools/sim/scene_placement.h"

namespace nanomap::sim {
namespace {

constexpr double kDegreesARadian = 180.0 / std::numbers::pi;

/// @param flown  of the flight process
LinkParameters linkTo(const std::string& url, const LinkParameters& flown) {
  LinkParameters parameters;
  parameters.url = url;
  parameters.system_id = flown.system_id;
  parameters.component_id = 194;  // MAV_COMP_ID_ONBOARD_COMPUTER4: not the flight process's
  parameters.pose_rate_hz = 100.0;
  return parameters;
}

/// @throws std::runtime_error naming the URL
AutopilotPose awaitVehicle(MavlinkLink& link, const std::string& url, const std::function<bool()>& stopped) {
  constexpr Duration kPatience = std::chrono::seconds(60);
  constexpr Duration kRound = std::chrono::milliseconds(50);
  for (Duration waited{}; waited < kPatience && !stopped(); waited += kRound) {
    link.keepAlive(SystemStatus::kActive);
    std::optional<AutopilotPose> newest;
    while (const auto pose = link.takePose()) newest = pose;
    // Whether it stands on the ground says where the ground is.
    if (newest && link.autopilot().landed != LandedState::kUnknown) return *newest;
    std::this_thread::sleep_for(kRound);
  }
  if (stopped()) throw std::runtime_error("stopped while it waited for an autopilot");
  if (const auto other = link.otherAutopilot()) {
    throw std::runtime_error(
        fmt::format("the autopilot on {} is that of system {}: set mavlink.system_id", url, *other));
  }
  throw std::runtime_error(fmt::format(
      "no autopilot on {} that tells its position, attitude and landed state. Does it run, does it send there, and has "
      "its estimator a position?",
      url));
}

}  // namespace

LiveFlight flyLive(const Configuration& configuration, const generate::SensedFlight& flight,
                   const LiveFlightOptions& options, const std::function<void(const std::string&)>& tell,
                   const std::function<bool()>& stopped) {
  const MavsdkLog quiet([](MavsdkLog::Level, std::string_view) {});
  const LogClock clock = monotonicLogClock();
  LcmNetwork network(configuration.lcm.url, {configuration.lcm.health_channel, configuration.lcm.decisions_channel});
  MavlinkLink link(linkTo(options.autopilot_url, configuration.mavlink.link), clock.now);
  std::optional<LogWriter> log;
  if (options.log) log.emplace(*options.log);

  tell(fmt::format("waits for an autopilot on {}", options.autopilot_url));
  const AutopilotPose vehicle = awaitVehicle(link, options.autopilot_url, stopped);
  const bool on_ground = link.autopilot().landed == LandedState::kOnGround;
  const double heading_rad = options.heading_rad.value_or(vehicle.heading_rad);
  const simulation::Mission& mission = flight.scene().mission();
  tell(fmt::format(
      "scene '{}' lies around the vehicle, {}; the goal is {:.0f} m away at {:.0f} degrees from north, "
      "{:.1f} m above the ground; messages go to {}",
      flight.scene().name(), on_ground ? "which stands on the ground" : "which is in the air",
      (mission.goal_W - mission.start_W).norm(), heading_rad * kDegreesARadian, mission.goal_W.z(), network.url()));

  const LiveSurroundings surroundings{
      .autopilot = link,
      .heard = network,
      .publish = [&](const std::string& channel, Bytes message) { return network.publish(channel, message); },
      .now = clock.now,
      .stopped = stopped,
      .log = log ? &*log : nullptr};
  TrueMotion motion(placeScene(mission, vehicle, on_ground, heading_rad));
  motion.add(vehicle);
  LiveFlyer flyer(configuration, flight.scene(), options.vehicle_radius_m, fromSeconds(1.0 / flight.options().depth_hz),
                  std::move(motion), options.faults, options.message_faults, surroundings);
  LiveFlight result;
  result.start = std::chrono::ceil<std::chrono::microseconds>(clock.now());
  result.sensed = flight.fly(configuration.lcm, result.start, options.duration, flyer);
  if (log) log->close();
  result.flown = flyer.summary();
  return result;
}

}  // namespace nanomap::sim
