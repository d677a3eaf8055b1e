#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/time.h"

namespace nanomap {

/// What systemd is told, as sd_notify(3) has it. Without systemd, where NOTIFY_SOCKET is not set, nothing is told and
/// nothing is missing.
/// Threads: one, which no real-time thread waits for: systemd may take its time. Reads no clock.
class ServiceManager {
 public:
  /// Reads NOTIFY_SOCKET, WATCHDOG_USEC and WATCHDOG_PID.
  ServiceManager();

  [[nodiscard]] bool present() const { return present_; }

  /// How long systemd waits for a sign of life before it restarts us; empty: it does not.
  [[nodiscard]] std::optional<Duration> watchdogLimit() const { return watchdog_limit_; }

  /// Start-up is over.
  void ready();
  /// One line for `systemctl status`; said again only when it changes.
  void setStatus(std::string_view status);
  /// To be called often, at a third of the limit or faster: a sign of life goes to systemd only while all threads show
  /// theirs, and three within the limit.
  void signOfLife(bool all_alive, Time now);
  /// We are about to end, for this reason.
  void stopping(std::string_view status);

  /// Messages that systemd did not get.
  [[nodiscard]] std::uint64_t unsent() const { return unsent_; }

 private:
  void notify(const std::string& state);

  bool present_;
  std::optional<Duration> watchdog_limit_;
  std::optional<Time> last_sign_;
  std::string status_;
  std::uint64_t unsent_ = 0;
};

}  // namespace nanomap
