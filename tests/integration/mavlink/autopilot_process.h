#pragma once

#include <sys/types.h>

#include <chrono>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace nanomap::test {

/// tools/autopilot as a process of its own: we are its pilot, and see what it sees.
class AutopilotProcess {
 public:
  /// Starts it and waits until it says where it can be reached.
  /// @throws std::runtime_error if it does not
  explicit AutopilotProcess(const std::vector<std::string>& arguments);
  ~AutopilotProcess();
  AutopilotProcess(const AutopilotProcess&) = delete;
  AutopilotProcess& operator=(const AutopilotProcess&) = delete;

  /// Where MAVSDK can reach it.
  [[nodiscard]] const std::string& url() const { return url_; }

  /// As nanomap_autopilot.py reads it.
  void order(const std::string& line) const;

  /// Reads what it has printed; waits for some if there is none.
  void read(std::chrono::milliseconds wait);

  [[nodiscard]] const std::vector<nlohmann::json>& events() const { return events_; }
  /// The received messages of that name.
  [[nodiscard]] std::vector<nlohmann::json> messages(const std::string& name) const;
  [[nodiscard]] bool saw(const std::string& event, const std::string& mode) const;

 private:
  pid_t pid_ = 0;
  int orders_ = -1;
  int output_ = -1;
  std::string rest_;
  std::vector<nlohmann::json> events_;
  std::string url_;
};

}  // namespace nanomap::test
