#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_network.h"
#include "drivers/mavlink/mavlink_link.h"
#include "firmware_app/flight/flight_process.h"
#include "firmware_app/health/health_monitor.h"
#include "firmware_app/recorder/recorder.h"
#include "firmware_app/supervision/end_signals.h"
#include "firmware_app/supervision/service_manager.h"

namespace nanomap {

/// What is reported on.
struct ReportedParts {
  FlightProcess& process;
  HandOvers& hand_overs;
  LcmNetwork& network;
  const MavlinkLink& link;
  Recorder* recorder = nullptr;  ///< null: nothing is recorded
};

/// Tells how the process is: once a second over LCM, into the recording, on the terminal and to systemd; at once, if a
/// thread stalls. Threads: one, of no real-time scheduling.
class Reporter {
 public:
  /// Borrows the parts. @param health_channel  of the LCM network
  Reporter(const ReportedParts& parts, std::string health_channel);

  /// Until one of the signals comes, or the source has ended; and until what is flown then has been braked to a
  /// standstill, unless another signal comes.
  void run(const EndSignals& signals);

 private:
  void round(Time now);
  void endFlight(const EndSignals& signals);
  void tell(Time now);
  [[nodiscard]] NamedCounters others();
  void tellOfRecording(NamedCounters& others);
  void tellOfOtherAutopilot();

  ReportedParts parts_;
  std::string health_channel_;
  HealthMonitor monitor_;
  Time next_tell_{};
  ServiceManager service_;
  RecorderReport recording_;
  std::string recording_fault_told_;
  std::optional<std::uint8_t> other_autopilot_told_;
  std::vector<std::uint8_t> encoded_;
};

}  // namespace nanomap
