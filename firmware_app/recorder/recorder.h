#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/recording/rotating_log.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/pipeline/step.h"
#include "firmware_app/recorder/message_tap.h"
#include "firmware_app/stages/handed_over.h"
#include "firmware_app/stages/sink_stage.h"
#include "nanomap/health_t.hpp"

namespace nanomap {

/// Where the recorder is handed something.
enum class Tap : std::uint8_t { kMessages, kSteps, kDecisions, kSetpoints, kHealth };
inline constexpr std::size_t kTapCount = 5;

[[nodiscard]] std::string_view toString(Tap tap);

/// Hand-overs that the recorder alone takes from. Borrowed.
struct RecorderPorts {
  SlotQueue<Step>& steps;
  SlotQueue<MadeDecision>& decisions;
  SlotQueue<SentSetpoint>& setpoints;
};

/// How the recording is, for the health report.
struct RecorderReport {
  std::array<std::uint64_t, kTapCount> dropped{};  ///< for want of room on the way to the recorder
  RotatingLogCounters log;
  std::string fault;  ///< of the disk; empty: none
};

/// Records a flight: every message as it arrived, the order in which things were taken in, what was decided and sent,
/// the state and the health, with the configuration, so that a replay reaches the same decisions. Whoever hands over
/// neither waits nor allocates; what finds no room is lost, counted, and told at its place in the log.
/// Threads: one runs it, of no real-time scheduling. Each tap has one producer of its own.
class Recorder {
 public:
  /// Begins the flight's recording. Allocates the taps.
  /// @param configuration  recorded too; its [recorder] says how much is kept
  /// @throws as RotatingLog's constructor
  Recorder(const std::filesystem::path& folder, const Configuration& configuration, const RecorderPorts& ports,
           Time now);

  /// For the ingest's thread: every message of a configured channel, before it is looked at.
  /// @param arrival  later than any before
  void onMessage(std::string_view channel, Time arrival, Bytes message);

  /// For the health thread.
  void onHealth(const health_t& health);

  /// Writes what waits; to be called several times in RotatingLog::kFlushPeriod, and as often as the taps have room
  /// for.
  void run(Time now);

  /// Writes what waits and ends the recording. @pre nobody hands over any more
  void close(Time now);

  /// For one thread: what the last rounds came to.
  [[nodiscard]] Mailbox<RecorderReport>& report() { return report_; }

  [[nodiscard]] const std::filesystem::path& path() const { return log_.path(); }

 private:
  void writeMessages();
  void write(const Step& step);
  void write(const MadeDecision& decision);
  void write(const SentSetpoint& setpoint);
  void tellLosses(Time now);
  void tellLoss(Time now, std::string_view what, std::uint64_t total, std::uint64_t& told);
  [[nodiscard]] std::array<std::uint64_t, kTapCount> dropped() const;

  template <class T>
  void writeAll(SlotQueue<T>& queue);
  template <class Message>
  bool put(const std::string& channel, Time log_stamp, const Message& message, Retention retention = Retention::kOnce);

  LcmParameters lcm_;
  RecorderPorts ports_;
  RotatingLog log_;
  MessageTap messages_;
  SlotQueue<health_t> health_;
  std::array<std::uint64_t, kTapCount> told_{};  ///< of those dropped
  std::uint64_t told_by_log_ = 0;                ///< of those that the log lost
  std::string state_;                            ///< written last
  std::string channel_;                          ///< reused, as is what is encoded
  std::vector<std::uint8_t> encoded_;
  Mailbox<RecorderReport> report_;
};

}  // namespace nanomap
