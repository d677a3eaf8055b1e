#include "tests/integration/doctor/live_vehicle.h"

#include <cstddef>

#include "drivers/lcm/lcm_network.h"
#include "firmware_app/flight/process_clock.h"
#include "tests/integration/doctor/recorded_flight.h"

namespace nanomap::test {
namespace {

/// Adds to the stamp that every message of ours begins with, behind its hash: a big-endian 64-bit number.
void shiftStamp(std::vector<std::uint8_t>& message, Duration shift) {
  constexpr std::size_t kBegin = 8;
  constexpr std::size_t kEnd = 16;
  std::uint64_t utime = 0;
  for (std::size_t i = kBegin; i < kEnd; ++i) utime = (utime << 8U) | message[i];
  utime += static_cast<std::uint64_t>(std::chrono::duration_cast<std::chrono::microseconds>(shift).count());
  for (std::size_t i = kEnd; i > kBegin; --i, utime >>= 8U) message[i - 1] = static_cast<std::uint8_t>(utime);
}

}  // namespace

LiveVehicle::LiveVehicle(const std::string& lcm_url, Duration ahead)
    : lcm_url_(lcm_url), ahead_(ahead), thread_([this](const std::stop_token& stop) { fly(stop); }) {}

void LiveVehicle::fly(const std::stop_token& stop) const {
  LcmNetwork network(lcm_url_, std::vector<std::string>{});
  while (!stop.stop_requested()) {
    const Duration since_recording = processNow() - healthyFlight().front().arrival;
    for (const RecordedMessage& message : healthyFlight()) {
      sleepUntil(message.arrival + since_recording);
      if (stop.stop_requested()) return;
      std::vector<std::uint8_t> bytes = message.bytes;
      shiftStamp(bytes, since_recording + ahead_);
      (void)network.publish(message.channel, bytes);
    }
  }
}

}  // namespace nanomap::test
