#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>

#include "drivers/mavlink/mavlink_link.h"
#include "drivers/mavlink/mavsdk_log.h"
#include "tests/integration/mavlink/autopilot_process.h"
#include "tests/support/udp_port.h"

namespace nanomap::test {

inline Time monotonicNow() { return Time(std::chrono::steady_clock::now().time_since_epoch()); }

enum class Wire { kUdp, kTcp, kSerial };

/// An autopilot and our side of the link to it, which is kept alive while we wait for something.
class Companion {
 public:
  /// @param system_id  of our vehicle; the autopilot's is 1 unless the arguments say `--system`
  explicit Companion(Wire wire, const std::vector<std::string>& more_arguments = {}, std::uint8_t system_id = 1)
      : autopilot(argumentsOf(wire, more_arguments)), link(parametersOf(autopilot.url(), system_id), monotonicNow) {}

  static constexpr Duration kHeartbeatTimeout = std::chrono::milliseconds(2500);

  MavsdkLog quiet{[](MavsdkLog::Level, std::string_view) {}};
  AutopilotProcess autopilot;
  MavlinkLink link;
  SystemStatus status = SystemStatus::kStandby;
  std::optional<LocalNedTarget> streamed;  ///< sent, with a stamp of the moment, in every round

  /// Until `condition` holds; false if it does not within a time that is long even for a busy machine.
  [[nodiscard]] bool until(const std::function<bool()>& condition) {
    constexpr auto kPatience = std::chrono::seconds(30);
    constexpr auto kRound = std::chrono::milliseconds(20);
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition()) {
      if (std::chrono::steady_clock::now() > deadline) return false;
      link.keepAlive(status);
      if (streamed) {
        streamed->time_boot_ms = bootMilliseconds(monotonicNow());
        (void)link.send(*streamed);
      }
      const auto round_end = std::chrono::steady_clock::now() + kRound;
      for (auto left = kRound; left.count() > 0;
           left = std::chrono::duration_cast<std::chrono::milliseconds>(round_end - std::chrono::steady_clock::now())) {
        autopilot.read(left);
      }
    }
    return true;
  }

  [[nodiscard]] bool untilLinked() {
    return until([&] { return link.autopilot().linked && link.autopilot().position_age; });
  }

  [[nodiscard]] bool untilReceived(const std::string& name, std::size_t count = 1) {
    return until([&] { return autopilot.messages(name).size() >= count; });
  }

 private:
  static std::vector<std::string> argumentsOf(Wire wire, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = more;
    if (wire == Wire::kUdp) arguments.insert(arguments.end(), {"--udp", std::to_string(UdpPort().number())});
    if (wire == Wire::kTcp) arguments.emplace_back("--tcp");
    if (wire == Wire::kSerial) arguments.emplace_back("--serial");
    return arguments;
  }

  static LinkParameters parametersOf(const std::string& url, std::uint8_t system_id) {
    LinkParameters parameters;
    parameters.url = url;
    parameters.system_id = system_id;
    parameters.heartbeat_timeout = kHeartbeatTimeout;
    return parameters;
  }
};

}  // namespace nanomap::test
