#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_network.h"
#include "drivers/mavlink/mavlink_link.h"
#include "drivers/recording/log_source.h"
#include "firmware_app/configuration/load.h"
#include "firmware_app/flight/arguments.h"
#include "firmware_app/flight/flight_process.h"
#include "firmware_app/flight/process_clock.h"
#include "firmware_app/flight/recording.h"
#include "firmware_app/flight/reporter.h"
#include "firmware_app/flight/surroundings.h"
#include "firmware_app/supervision/end_signals.h"

namespace nanomap {
namespace {

std::vector<std::string> channelsOf(const LcmParameters& lcm) {
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < kInputKindCount; ++i) channels.push_back(channelOf(lcm, static_cast<InputKind>(i)));
  return channels;
}

int run(const FlightArguments& arguments) {
  const EndSignals signals;
  Configuration configuration = loadConfiguration(arguments.config, arguments.overrides);
  const bool from_network = arguments.log.empty();
  if (!from_network) configuration.lcm.clock = ClockDomain::kLog;
  const Surroundings surroundings = prepare(configuration, arguments.allow_no_realtime);
  for (const std::string& text : surroundings.remarks) spdlog::warn("{}", text);
  if (arguments.check) return 0;

  LcmNetwork network(configuration.lcm.url, from_network ? channelsOf(configuration.lcm) : std::vector<std::string>{});
  if (network.warning()) spdlog::warn("{}", *network.warning());
  std::optional<LogSource> log;
  if (!from_network) log.emplace(LogReader(arguments.log), channelsOf(configuration.lcm), 1.0, monotonicLogClock());
  MavlinkLink link(configuration.mavlink.link, processNow);
  spdlog::info("messages from {}, autopilot on {}", from_network ? network.url() : arguments.log,
               configuration.mavlink.link.url);

  Stages stages(configuration, realtimeAhead(), link);
  std::optional<Recording> recording;
  FlightOptions options;
  options.layout = surroundings.layout;
  options.setpoint_rate_hz = configuration.mavlink.setpoint_rate_hz;
  options.frame_deadline = configuration.frame_deadline;
  options.demand_realtime = !arguments.allow_no_realtime;
  if (!arguments.record.empty()) {
    recording.emplace(arguments.record, configuration, stages.hand_overs);
    spdlog::info("recording in {}", recording->recorder().path().string());
    options.on_message = [&recorder = recording->recorder()](const ReceivedMessage& message, Time arrival) {
      recorder.onMessage(message.channel, arrival, message.bytes);
    };
  }
  FlightProcess process(options, log ? static_cast<MessageSource&>(*log) : network, stages);
  Reporter reporter({process, stages.hand_overs, network, link, recording ? &recording->recorder() : nullptr},
                    configuration.lcm.health_channel);
  reporter.run(signals);
  if (from_network && process.sourceEnded()) {
    throw std::runtime_error("LCM: nothing can be received on '" + network.url() +
                             "' any more. Look whether its network interface is still there, and start again.");
  }
  return 0;
}

}  // namespace
}  // namespace nanomap

int main(int argc, char** argv) {
  CLI::App app(
      "Flies a drone around obstacles: depth images, poses and goals from LCM, setpoints to a PX4 or ArduPilot over\n"
      "MAVLink. It never arms and never changes the mode: switch to OFFBOARD or GUIDED once it says that it is ready.",
      "nanomap-flight");
  nanomap::FlightArguments arguments;
  declare(app, arguments);
  CLI11_PARSE(app, argc, argv);
  try {
    return nanomap::run(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "nanomap-flight: {}\n", error.what());
    return 1;
  }
}
