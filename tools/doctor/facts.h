#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "drivers/mavlink/autopilot_state.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/realtime/realtime_facts.h"
#include "firmware_app/realtime/thread_layout.h"
#include "tools/doctor/heard.h"

namespace nanomap::doctor {

/// How the kernel receives datagrams for LCM.
struct ReceiveBuffer {
  int wanted_bytes = 0;
  std::optional<int> granted_bytes;     ///< to a socket of this process; empty: none could be opened
  std::optional<int> limit_bytes;       ///< net.core.rmem_max; empty: the kernel does not say
  std::optional<std::uint64_t> lost{};  ///< datagrams, while listening
};

/// A /dev/video node.
struct VideoNode {
  std::string path;
  bool accessible = false;  ///< may be read and written by this user
};

/// Where flights are to be recorded.
struct Disk {
  std::string folder;
  bool writable = false;
  std::uint64_t free_bytes = 0;
  std::uint64_t recorded_bytes = 0;  ///< in it already: of earlier flights
};

/// The machine that flies. Empty parts were not asked for.
struct MachineFacts {
  RealtimeFacts realtime;
  std::string layout_fault;  ///< of [realtime] on this machine, in words; empty: none
  std::vector<VideoNode> video;
  std::optional<Disk> disk;
};

/// What became of the connection to the autopilot.
struct AutopilotFacts {
  std::string fault;        ///< why there is no connection, in words; empty: there is one
  bool port_taken = false;  ///< that is why
  AutopilotState state;
  std::optional<std::uint8_t> other_system;  ///< of an autopilot that is heard, but not the vehicle's
  /// By name. Empty: it did not answer.
  std::map<std::string, std::optional<double>> parameters;
};

/// All that is known before anything is judged. Empty parts were not looked at.
struct Facts {
  Configuration configuration;
  std::string configuration_origin;  ///< in words
  std::string lcm_fault;             ///< why nothing can be heard, in words; empty: it can
  std::optional<Heard> heard;
  std::optional<ReceiveBuffer> receive_buffer;
  std::optional<MachineFacts> machine;
  std::optional<AutopilotFacts> autopilot;

  /// The one that flight would use: the configured one, or as the camera itself says. Empty: there is none.
  [[nodiscard]] std::optional<CameraParameters> camera() const;
};

}  // namespace nanomap::doctor
