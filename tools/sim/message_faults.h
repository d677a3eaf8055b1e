#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include "core/time.h"
#include "drivers/lcm/byte_cursor.h"
#include "firmware_app/configuration/configuration.h"
#include "nanomap/depth_image_t.hpp"
#include "tools/sim/sensor_fault_plan.h"

namespace nanomap::sim {

/// What befalls messages on their way.
enum class MessageFault : std::uint8_t {
  kCameraFrozen,        ///< one picture again and again, under new stamps
  kCameraLate,          ///< every frame by kLateness
  kCameraFlickers,      ///< frames for kFlicker, then none for as long, by turns
  kCameraGarbage,       ///< any bytes
  kPosesLate,           ///< by kLateness
  kPosesNotANumber,     ///< a place that is none
  kPosesGarbage,        ///< any bytes
  kCorrectionsJump,     ///< by metres, every other one
  kCorrectionsGarbage,  ///< any bytes
  kGoalNonsense,        ///< not a number, and infinitely far, by turns
  kFlood,               ///< with every pose, a burst of any bytes on all channels
};
inline constexpr std::size_t kMessageFaultCount = 11;

/// As on the command line: "camera-frozen".
[[nodiscard]] std::string_view toString(MessageFault fault);

/// All of them, for people.
[[nodiscard]] std::string namesOfMessageFaults();

struct PlannedMessageFault {
  MessageFault fault = MessageFault::kFlood;
  Outage when;
};

/// "camera-frozen:5:1": what, seconds after the departure, seconds. @throws std::invalid_argument naming the option and
/// the text
[[nodiscard]] PlannedMessageFault parseMessageFault(std::string_view option, std::string_view text);

/// Lets messages pass from the simulated sensors to the network, and has some befallen by faults. Threads: one.
class MessageFaults {
 public:
  static constexpr Duration kLateness = std::chrono::milliseconds(500);
  static constexpr Duration kFlicker = std::chrono::milliseconds(300);

  using Send = std::function<void(const std::string& channel, Bytes message)>;

  MessageFaults(const LcmParameters& channels, std::vector<PlannedMessageFault> plan);

  /// A message on its way, and whatever was kept back and is due.
  /// @param since_departure  empty: the vehicle is still at its start, and nothing befalls anyone
  void pass(const std::string& channel, Time arrival, Bytes message, std::optional<Duration> since_departure,
            const Send& send);

 private:
  struct KeptBack {
    Time due{};
    std::string channel;
    std::vector<std::uint8_t> message;
  };

  [[nodiscard]] bool isOn(MessageFault fault) const;
  /// Empty: it is lost.
  [[nodiscard]] std::optional<Bytes> befallen(const std::string& channel, Time arrival, Bytes message);
  [[nodiscard]] Bytes frozen(Bytes message);
  [[nodiscard]] Bytes garbage(std::size_t size);
  void flood(const Send& send);

  LcmParameters channels_;
  std::vector<PlannedMessageFault> plan_;
  std::optional<Duration> since_departure_;  ///< of the message that passes
  std::deque<KeptBack> late_;
  std::optional<depth_image_t> picture_;  ///< the one that is frozen
  std::mt19937 random_{1};
  bool odd_ = false;                   ///< of those that come by turns
  std::vector<std::uint8_t> encoded_;  ///< what befallen() returned last
};

}  // namespace nanomap::sim
