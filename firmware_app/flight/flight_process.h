#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/lcm/message_source.h"
#include "drivers/mavlink/autopilot_link.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/flight/frame_deadline.h"
#include "firmware_app/flight/process_clock.h"
#include "firmware_app/flight/worker.h"
#include "firmware_app/realtime/thread_layout.h"
#include "firmware_app/stages/stages.h"
#include "firmware_app/supervision/watchdog.h"

namespace nanomap {

struct FlightOptions {
  ThreadLayout layout;
  double setpoint_rate_hz = 50.0;
  Duration frame_deadline = std::chrono::milliseconds(33);  ///< from a depth frame's arrival to the plan that knows it
  bool demand_realtime = true;
  /// Told every message of a configured channel as it arrived, on the ingest's thread, before anyone else.
  std::function<void(const ReceivedMessage&, Time arrival)> on_message = [](const ReceivedMessage&, Time) {};
};

/// Depth frames that had not left a stage by their deadline; one that is late from an early stage is in the later ones.
struct LateFrames {
  std::uint64_t index = 0;
  std::uint64_t chain = 0;
  std::uint64_t planner = 0;  ///< those that were never planned with among them
};

/// The stages on their threads, from messages to setpoints: what flies. Recorder and health take from its hand-overs.
/// Threads: made and destroyed by one, which must have no real-time scheduling: the plain threads are made first, and
/// inherit it.
class FlightProcess {
 public:
  /// Starts every thread. Borrows source and stages, which must outlive it; nobody else runs the stages.
  /// @throws std::invalid_argument naming the parameter that is wrong; std::runtime_error naming what the machine
  ///         refuses and what to do
  FlightProcess(const FlightOptions& options, MessageSource& source, Stages& stages);
  ~FlightProcess();

  /// The source has nothing more, and never will.
  [[nodiscard]] bool sourceEnded() const { return source_ended_.load(std::memory_order_relaxed); }

  /// All threads; those in real time first, by stage.
  [[nodiscard]] std::vector<const Worker*> workers() const;

  /// Every thread shows signs of life, by the word of the watchdog, and so does the watchdog itself.
  [[nodiscard]] bool allAnswer() const;

  /// What the watchdog has found since it was asked last: for one thread, which tells it to people.
  [[nodiscard]] std::vector<std::string> takeStalls();

  [[nodiscard]] LateFrames lateFrames() const {
    return {index_deadline_.missed(), chain_deadline_.missed(),
            planner_deadline_.missed() + stages_.hand_overs.moments.replaced()};
  }

  /// Rounds of the sink that began late by more than half a period.
  [[nodiscard]] std::uint64_t lateSetpoints() const { return late_setpoints_.load(std::memory_order_relaxed); }

 private:
  void ingest(MessageSource& source);
  void index();
  void chain();
  void plan();
  void sink();
  void watch();

  FlightOptions options_;
  Duration setpoint_period_;

  Stages& stages_;
  Time next_setpoint_{};

  std::atomic<bool> source_ended_{false};
  std::atomic<Time> watched_{processNow()};  ///< when the watchdog looked last
  std::atomic<std::uint64_t> late_setpoints_{0};
  FrameDeadline index_deadline_;
  FrameDeadline chain_deadline_;
  FrameDeadline planner_deadline_;
  SlotQueue<Stall> stalls_{64};
  std::vector<std::unique_ptr<Worker>> workers_;
  std::unique_ptr<Watchdog> watchdog_;
  std::unique_ptr<Worker> watcher_;
  Time next_watch_{};
};

}  // namespace nanomap
