#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <CLI/CLI.hpp>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/lcm/encode.h"
#include "drivers/lcm/lcm_network.h"
#include "drivers/mavlink/mavlink_link.h"
#include "drivers/recording/log_source.h"
#include "firmware_app/configuration/load.h"
#include "firmware_app/flight/arguments.h"
#include "firmware_app/flight/flight_process.h"
#include "firmware_app/flight/process_clock.h"
#include "firmware_app/flight/surroundings.h"
#include "firmware_app/health/health_monitor.h"
#include "firmware_app/supervision/end_signals.h"
#include "firmware_app/supervision/service_manager.h"

namespace nanomap {
namespace {

constexpr Duration kHealthPeriod = std::chrono::seconds(1);
constexpr Duration kRound = std::chrono::milliseconds(100);

/// What is still under way when a log has ended needs no longer.
constexpr Duration kAfterTheEnd = std::chrono::seconds(1);

std::vector<std::string> channelsOf(const LcmParameters& lcm) {
  std::vector<std::string> channels;
  for (std::size_t i = 0; i < kInputKindCount; ++i) channels.push_back(channelOf(lcm, static_cast<InputKind>(i)));
  return channels;
}

NamedCounters othersOf(const FlightProcess& process, const LcmNetwork& network, const MavlinkLink& link) {
  const LinkCounters link_counters = link.counters();
  NamedCounters others{{"late setpoints", process.lateSetpoints()},
                       {"setpoints held back as stale", link_counters.stale_setpoints},
                       {"lcm: datagrams lost", network.loss().datagrams},
                       {"lcm: full queues", network.loss().full_queues}};
  for (const Worker* worker : process.workers()) {
    if (!worker->settings().place) continue;
    others.emplace_back(worker->settings().name + ": page faults",
                        static_cast<std::uint64_t>(worker->usage().faults()));
    others.emplace_back(worker->settings().name + ": allocations", worker->allocations());
  }
  return others;
}

/// Reports until a signal, or the end of the log.
void report(FlightProcess& process, LcmNetwork& network, const MavlinkLink& link, const std::string& health_channel,
            const EndSignals& signals, ServiceManager& service) {
  HealthMonitor monitor(process.handOvers());
  Time next = processNow();
  std::optional<Time> ended;
  std::vector<std::uint8_t> bytes;
  while (!signals.wait(kRound)) {
    const Time now = processNow();
    monitor.gather();
    const auto stalls = process.takeStalls();
    service.signOfLife(stalls.empty(), now);
    if (!stalls.empty()) spdlog::error("{}", fmt::join(stalls, "; "));
    if (now >= next) {
      next = now + kHealthPeriod;
      const health_t health = monitor.report(now, othersOf(process, network, link));
      if (!encodeInto(health, bytes) || !network.publish(health_channel, bytes)) {
        spdlog::warn("the health report was not sent over LCM");
      }
      const std::string line = statusLine(health);
      spdlog::info("{}", line);
      service.setStatus(line);
    }
    if (process.sourceEnded() && !ended) ended = now;
    if (ended && now - *ended >= kAfterTheEnd) {
      spdlog::info("the log has ended");
      return;
    }
  }
}

int run(const FlightArguments& arguments) {
  const EndSignals signals;
  Configuration configuration = loadConfiguration(arguments.config, arguments.overrides);
  if (!arguments.log.empty()) configuration.lcm.clock = ClockDomain::kLog;
  const bool from_network = arguments.log.empty();
  const Surroundings surroundings = prepare(configuration, arguments.allow_no_realtime);
  for (const std::string& text : surroundings.remarks) spdlog::warn("{}", text);
  if (arguments.check) return 0;

  LcmNetwork network(configuration.lcm.url, from_network ? channelsOf(configuration.lcm) : std::vector<std::string>{});
  if (network.warning()) spdlog::warn("{}", *network.warning());
  std::unique_ptr<LogSource> log;
  if (!from_network) {
    log =
        std::make_unique<LogSource>(LogReader(arguments.log), channelsOf(configuration.lcm), 1.0, monotonicLogClock());
  }
  MessageSource& source = from_network ? static_cast<MessageSource&>(network) : *log;
  MavlinkLink link(configuration.mavlink.link, processNow);
  spdlog::info("messages from {}, autopilot on {}", from_network ? network.url() : arguments.log,
               configuration.mavlink.link.url);

  ServiceManager service;
  FlightOptions options;
  options.layout = surroundings.layout;
  options.demand_realtime = !arguments.allow_no_realtime;
  FlightProcess process(configuration, options, source, link);
  service.ready();
  report(process, network, link, configuration.lcm.health_channel, signals, service);
  service.stopping("stopped");
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
