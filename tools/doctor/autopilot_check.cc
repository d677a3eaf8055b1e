#include <fmt/format.h>

#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kSubject = "autopilot";

Finding judgeNoConnection(const Facts& facts) {
  const bool flying = facts.heard && facts.heard->health;
  if (!facts.autopilot->port_taken) return failure(kSubject, "no connection", facts.autopilot->fault);
  if (!flying) return failure(kSubject, "another process has the port", facts.autopilot->fault);
  return notLookedAt(
      kSubject, fmt::format("nanomap-flight runs and has {}; it says: {}{}{}. To look at the autopilot, stop it first",
                            facts.configuration.mavlink.link.url, facts.heard->health->state,
                            facts.heard->health->reason.empty() ? "" : ", ", facts.heard->health->reason));
}

}  // namespace

Findings checkAutopilot(const Facts& facts) {
  const AutopilotFacts& autopilot = *facts.autopilot;
  const LinkParameters& link = facts.configuration.mavlink.link;
  if (!autopilot.fault.empty()) return {judgeNoConnection(facts)};
  const AutopilotState& state = autopilot.state;
  if (!state.heartbeat_age && autopilot.other_system) {
    return {failure(kSubject,
                    fmt::format("the autopilot of system {} is heard, but mavlink.system_id = {}",
                                *autopilot.other_system, link.system_id),
                    fmt::format("mavlink.system_id = {} if that is the vehicle's: a companion computer is a part of "
                                "its vehicle, and commands no other one",
                                *autopilot.other_system))};
  }
  if (!state.heartbeat_age) {
    return {failure(kSubject, fmt::format("no heartbeat of an autopilot on {}", link.url),
                    "mavlink.url: where it sends to a companion computer. PX4: MAV_1_CONFIG and its rate for a serial "
                    "line, port 14540 for its simulator; ArduPilot: SERIALn_PROTOCOL = 2, or --out of its simulator")};
  }
  if (!state.linked) {
    return {failure(kSubject,
                    fmt::format("its last heartbeat is {:.1f} s old; mavlink.heartbeat_timeout_s = {:g}",
                                toSeconds(*state.heartbeat_age), toSeconds(link.heartbeat_timeout)),
                    "look at the line: power, baud rate, what else uses it")};
  }
  Findings findings;
  if (state.kind != AutopilotKind::kPx4 && state.kind != AutopilotKind::kArduPilot) {
    findings.push_back(failure(kSubject, fmt::format("it is {}", toString(state.kind)), "PX4 or ArduPilot is needed"));
  }
  if (autopilot.other_system) {
    const bool to_everyone = facts.configuration.mavlink.send_odometry || facts.configuration.mavlink.send_obstacles;
    const std::string seen = fmt::format("the autopilot of system {} is on the same link", *autopilot.other_system);
    const std::string fix =
        "give every vehicle a port or a line of its own: ODOMETRY and OBSTACLE_DISTANCE have no addressee";
    findings.push_back(to_everyone ? failure(kSubject, seen, fix) : warning(kSubject, seen, fix));
  }
  if (!state.position_age || !state.attitude_age) {
    findings.push_back(
        failure(kSubject,
                fmt::format("it tells no {}: without it there is no alignment",
                            state.position_age ? "attitude" : "local position"),
                "wait for its estimator (GPS, or external vision); it has to send LOCAL_POSITION_NED and "
                "ATTITUDE_QUATERNION when asked"));
  }
  if (findings.empty()) {
    findings.push_back(
        ok(kSubject, fmt::format("{}, system {}, {}, heartbeat {:.1f} s ago, position {:.0f} ms ago",
                                 toString(state.kind), link.system_id, state.armed ? "armed" : "disarmed",
                                 toSeconds(*state.heartbeat_age), toSeconds(*state.position_age) * 1e3)));
  }
  return findings;
}

}  // namespace nanomap::doctor
