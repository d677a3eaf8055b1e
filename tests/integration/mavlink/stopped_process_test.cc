#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

#include "tests/integration/mavlink/companion.h"

namespace nanomap::test {
namespace {

/// A process that streams setpoints at 50 Hz until it is killed.
class Streamer {
 public:
  explicit Streamer(const std::string& url) : pid_(fork()) {
    if (pid_ == 0) stream(url);
  }
  ~Streamer() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  Streamer(const Streamer&) = delete;
  Streamer& operator=(const Streamer&) = delete;

  void stop() const { kill(pid_, SIGSTOP); }
  void resume() const { kill(pid_, SIGCONT); }

 private:
  [[noreturn]] static void stream(const std::string& url) {
    constexpr int kPeriod_ms = 20;
    const MavsdkLog quiet([](MavsdkLog::Level, std::string_view) {});
    MavlinkLink link({.url = url}, monotonicNow);
    for (;; poll(nullptr, 0, kPeriod_ms)) {
      link.keepAlive(SystemStatus::kActive);
      (void)link.send(toNed(VelocitySetpoint{monotonicNow(), {1.0, 0.0, 0.0}, Vec3::Zero(), {}}, NedFromWorld()));
    }
  }

  pid_t pid_;
};

TEST(StoppedProcess, SendsAtMostOneStaleSetpointWhenItGoesOn) {
  AutopilotProcess autopilot({"--udp", std::to_string(UdpPort().number()), "--loss", "0.5"});
  const Streamer streamer(autopilot.url());
  const auto setpoints = [&] { return autopilot.messages("SET_POSITION_TARGET_LOCAL_NED"); };
  const auto until = [&](const std::function<bool()>& condition) {
    constexpr auto kPatience = std::chrono::seconds(30);
    const auto deadline = std::chrono::steady_clock::now() + kPatience;
    while (!condition() && std::chrono::steady_clock::now() < deadline) autopilot.read(std::chrono::milliseconds(100));
    return condition();
  };
  ASSERT_TRUE(until([&] { return setpoints().size() >= 60; }));
  autopilot.order("mode OFFBOARD");
  ASSERT_TRUE(until([&] { return autopilot.saw("mode", "OFFBOARD"); }));
  streamer.stop();
  ASSERT_TRUE(until([&] { return autopilot.saw("mode", "HOLD"); }));  // the failsafe acted
  const std::size_t before = setpoints().size();
  const Time resumed = monotonicNow();
  streamer.resume();
  ASSERT_TRUE(until([&] { return setpoints().size() >= before + 20; }));

  int stale = 0;
  const auto received = setpoints();
  for (std::size_t i = before; i < received.size(); ++i) {
    // Stamped before it was stopped, which was half a second ago.
    if (ageOf(received[i].at("fields").at("time_boot_ms").get<std::uint32_t>(), resumed) > Duration::zero()) ++stale;
  }
  EXPECT_LE(stale, 1);
}

}  // namespace
}  // namespace nanomap::test
