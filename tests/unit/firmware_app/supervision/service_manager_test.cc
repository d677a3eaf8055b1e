#include "firmware_app/supervision/service_manager.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <vector>

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Optional;

/// systemd's end: a socket in the abstract namespace, which needs no file.
class NotifySocket {
 public:
  NotifySocket() : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name_ = "@nanomap_notify_" + std::to_string(getpid());
    std::memcpy(address.sun_path + 1, name_.data() + 1, name_.size() - 1);  // NUL stands for the '@'
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name_.size());
    if (bind(socket_, static_cast<sockaddr*>(static_cast<void*>(&address)), size) != 0) {
      throw std::runtime_error("no socket for systemd's end");
    }
  }
  ~NotifySocket() { close(socket_); }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;

  [[nodiscard]] const std::string& name() const { return name_; }

  /// What has come since the last call; a message each.
  std::vector<std::string> messages() {
    std::vector<std::string> all;
    std::array<char, 4096> buffer{};
    for (ssize_t size = 0; (size = recv(socket_, buffer.data(), buffer.size(), 0)) >= 0;) {
      all.emplace_back(buffer.data(), static_cast<std::size_t>(size));
    }
    return all;
  }

 private:
  int socket_;
  std::string name_;
};

class ServiceManagerTest : public ::testing::Test {
 protected:
  void SetUp() override {
    setenv("NOTIFY_SOCKET", systemd_.name().c_str(), 1);
    setenv("WATCHDOG_USEC", "3000000", 1);
    setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  }
  void TearDown() override {
    for (const char* variable : {"NOTIFY_SOCKET", "WATCHDOG_USEC", "WATCHDOG_PID"}) unsetenv(variable);
  }

  NotifySocket systemd_;
};

TEST_F(ServiceManagerTest, TellsReadyStatusAndEnd) {
  ServiceManager manager;
  EXPECT_TRUE(manager.present());
  manager.ready();
  manager.setStatus("Waiting: no pose yet");
  manager.stopping("SIGTERM");
  EXPECT_THAT(systemd_.messages(), ElementsAre("READY=1", "STATUS=Waiting: no pose yet", "STOPPING=1\nSTATUS=SIGTERM"));
  EXPECT_EQ(manager.unsent(), 0U);
}

TEST_F(ServiceManagerTest, StatusIsSaidOnceAndInOneLine) {
  ServiceManager manager;
  manager.setStatus("a\nREADY=1");
  manager.setStatus("a\nREADY=1");
  manager.setStatus("b");
  EXPECT_THAT(systemd_.messages(), ElementsAre("STATUS=a READY=1", "STATUS=b"));
}

TEST_F(ServiceManagerTest, GivesThreeSignsOfLifeWithinTheLimit) {
  ServiceManager manager;
  ASSERT_THAT(manager.watchdogLimit(), Optional(Duration(3s)));
  for (Duration t = 0s; t < 3s; t += 100ms) manager.signOfLife(true, Time(t));
  EXPECT_THAT(systemd_.messages(), ElementsAre("WATCHDOG=1", "WATCHDOG=1", "WATCHDOG=1"));
}

TEST_F(ServiceManagerTest, GivesNoSignOfLifeWhileAThreadIsStalled) {
  ServiceManager manager;
  for (Duration t = 0s; t < 10s; t += 100ms) manager.signOfLife(false, Time(t));
  EXPECT_THAT(systemd_.messages(), IsEmpty());
  manager.signOfLife(true, Time(10s));
  EXPECT_THAT(systemd_.messages(), ElementsAre("WATCHDOG=1"));
}

TEST_F(ServiceManagerTest, WatchdogOfAnotherProcessIsNotOurs) {
  setenv("WATCHDOG_PID", "1", 1);
  ServiceManager manager;
  EXPECT_EQ(manager.watchdogLimit(), std::nullopt);
  manager.signOfLife(true, Time(0s));
  EXPECT_THAT(systemd_.messages(), IsEmpty());
}

TEST_F(ServiceManagerTest, WithoutSystemdNothingIsMissing) {
  unsetenv("NOTIFY_SOCKET");
  unsetenv("WATCHDOG_USEC");
  ServiceManager manager;
  EXPECT_FALSE(manager.present());
  EXPECT_EQ(manager.watchdogLimit(), std::nullopt);
  manager.ready();
  manager.signOfLife(true, Time(0s));
  EXPECT_EQ(manager.unsent(), 0U);
}

TEST_F(ServiceManagerTest, CountsWhatSystemdDoesNotGet) {
  setenv("NOTIFY_SOCKET", "/nowhere/to/be/found", 1);
  ServiceManager manager;
  manager.ready();
  EXPECT_EQ(manager.unsent(), 1U);
}

}  // namespace
}  // namespace nanomap
