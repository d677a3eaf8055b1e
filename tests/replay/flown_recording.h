#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/time.h"
#include "drivers/recording/rotating_log.h"
#include "firmware_app/configuration/configuration.h"

namespace nanomap::test {

/// One event of a recording.
struct RecordedEvent {
  std::string channel;
  Time log_stamp{};
  std::vector<std::uint8_t> message;
  Retention retention = Retention::kOnce;
};

/// What messages a flight is told by.
enum class FlightMessages : std::uint8_t {
  kNumbered,  ///< nanomap.body_pose_t and depth_image_t, with numbers and epochs of their own
  kPlain,     ///< bot_core.pose_t and images_t, without
};

struct FlownRecording {
  Configuration configuration;
  Time start{};                       ///< stamps of messages count from 0, on a clock of their own
  std::vector<RecordedEvent> events;  ///< as a recorder wrote them, decisions and steps among them
  std::size_t frames_dropped = 0;     ///< depth images that no step took in
  std::size_t overtaken = 0;          ///< steps that took in what had arrived before something taken in earlier
  std::size_t decisions = 0;

  /// Those on a channel, in their order.
  [[nodiscard]] std::vector<RecordedEvent> on(const std::string& channel) const;
};

/// A flight of 2 s towards a wall, as the flight process would have flown it: stages that take their time, each image
/// that was overtaken while the index was built dropped, messages of different kinds taken in out of order, plans made
/// of whatever was there when the last one was ready, a pilot who takes the vehicle over in between, and a recorder
/// that writes by turns what each of them hands over. It wires the stages by itself, so that a replay has something to
/// be compared with. The same seed, the same recording.
[[nodiscard]] FlownRecording flownRecording(FlightMessages messages, unsigned seed = 1);

/// Into one log. @return its path
std::filesystem::path writeLog(const std::vector<RecordedEvent>& events, const std::filesystem::path& path);

/// Into the parts of one flight.
void writeSegments(const std::vector<RecordedEvent>& events, const std::filesystem::path& folder,
                   const RotationLimits& limits);

}  // namespace nanomap::test
