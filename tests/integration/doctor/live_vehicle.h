#pragma once

#include <stop_token>
#include <string>
#include <thread>

#include "core/time.h"

namespace nanomap::test {

/// Sends the recorded flight over LCM as if it happened now, again and again, for as long as this lives.
class LiveVehicle {
 public:
  /// @param ahead  of the monotonic clock, that its stamps are of
  LiveVehicle(const std::string& lcm_url, Duration ahead);

 private:
  void fly(const std::stop_token& stop) const;

  std::string lcm_url_;
  Duration ahead_;
  std::jthread thread_;
};

}  // namespace nanomap::test
