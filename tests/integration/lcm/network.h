#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <vector>

#include "drivers/lcm/lcm_network.h"
#include "tests/support/udp_port.h"

namespace nanomap::test {

inline bool hasMulticast(const std::string& url) {
  try {
    const LcmNetwork network(url, {"TRY"});
    return true;
  } catch (const std::runtime_error&) {
    return false;
  }
}

/// Tests over real UDP multicast that stays on this machine, on a port of their own.
class MulticastTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!hasMulticast(url())) GTEST_SKIP() << "this machine has no route for UDP multicast";
  }

  [[nodiscard]] std::string url() const { return "udpm://239.255.76.67:" + std::to_string(port_.number()); }
  [[nodiscard]] int port() const { return port_.number(); }

  /// Hears messages until `enough` of them have come, or ten seconds have passed.
  void hear(MessageSource& source, std::size_t enough) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (heard_.size() < enough && std::chrono::steady_clock::now() < deadline) {
      (void)source.wait(std::chrono::milliseconds(100), [this](const ReceivedMessage& message) {
        heard_.push_back(std::string(message.channel) + ":" + std::string(message.bytes.begin(), message.bytes.end()));
        EXPECT_FALSE(message.log_stamp);
      });
    }
  }

  std::vector<std::string> heard_;  ///< as CHANNEL:text

 private:
  UdpPort port_;
};

[[nodiscard]] inline std::vector<std::uint8_t> bytesOf(const std::string& text) { return {text.begin(), text.end()}; }

}  // namespace nanomap::test
