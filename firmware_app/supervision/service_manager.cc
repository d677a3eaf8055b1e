#include "firmware_app/supervision/service_manager.h"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdlib>

namespace nanomap {
namespace {

constexpr int kKeepEnvironment = 0;
constexpr int kSignsWithinLimit = 3;

std::optional<Duration> watchdogLimitOfEnvironment() {
  std::uint64_t limit_us = 0;
  if (sd_watchdog_enabled(kKeepEnvironment, &limit_us) <= 0) return std::nullopt;
  return std::chrono::microseconds(limit_us);
}

/// A line end would start another assignment.
std::string statusLine(std::string_view status) {
  std::string line = "STATUS=" + std::string(status);
  std::replace(line.begin(), line.end(), '\n', ' ');
  return line;
}

}  // namespace

ServiceManager::ServiceManager()
    // NOLINTNEXTLINE(concurrency-mt-unsafe): nothing in this process changes its environment
    : present_(std::getenv("NOTIFY_SOCKET") != nullptr), watchdog_limit_(watchdogLimitOfEnvironment()) {}

void ServiceManager::ready() { notify("READY=1"); }

void ServiceManager::setStatus(std::string_view status) {
  if (status == status_) return;
  status_ = status;
  notify(statusLine(status));
}

void ServiceManager::signOfLife(bool all_alive, Time now) {
  if (!all_alive || !watchdog_limit_) return;
  if (last_sign_ && now - *last_sign_ < *watchdog_limit_ / kSignsWithinLimit) return;
  last_sign_ = now;
  notify("WATCHDOG=1");
}

void ServiceManager::stopping(std::string_view status) { notify("STOPPING=1\n" + statusLine(status)); }

void ServiceManager::notify(const std::string& state) {
  if (present_ && sd_notify(kKeepEnvironment, state.c_str()) <= 0) ++unsent_;
}

}  // namespace nanomap
