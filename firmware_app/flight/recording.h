#pragma once

#include <optional>
#include <string>

#include "firmware_app/configuration/configuration.h"
#include "firmware_app/flight/process_clock.h"
#include "firmware_app/flight/worker.h"
#include "firmware_app/recorder/recorder.h"
#include "firmware_app/stages/hand_overs.h"

namespace nanomap {

/// A recording under way, on a thread of its own, which nobody waits for.
class Recording {
 public:
  Recording(const std::string& folder, const Configuration& configuration, HandOvers& hand_overs)
      : recorder_(folder, configuration, {hand_overs.steps, hand_overs.decisions, hand_overs.setpoints}, processNow()),
        thread_(
            std::in_place, ThreadSettings{.name = "recorder"}, [] { sleepUntil(processNow() + kRecordPeriod); },
            [this] { recorder_.run(processNow()); }) {}
  /// @pre nobody hands over any more
  ~Recording() {
    thread_.reset();
    recorder_.close(processNow());
  }
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  [[nodiscard]] Recorder& recorder() { return recorder_; }

 private:
  static constexpr Duration kRecordPeriod = std::chrono::milliseconds(20);

  Recorder recorder_;
  std::optional<Worker> thread_;
};

}  // namespace nanomap
