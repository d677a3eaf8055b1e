#include "tests/integration/mavlink/autopilot_process.h"

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <stdexcept>

namespace nanomap::test {
namespace {

/// A pipe that children do not inherit, but for the end that is made their standard input or output.
std::array<int, 2> makePipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe to be had");
  return ends;
}

}  // namespace

AutopilotProcess::AutopilotProcess(const std::vector<std::string>& arguments) {
  std::vector<std::string> words{NANOMAP_PYTHON, NANOMAP_AUTOPILOT};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  const auto [orders_read, orders_write] = makePipe();
  const auto [output_read, output_write] = makePipe();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, orders_read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, output_write, STDOUT_FILENO);
  const int failed = posix_spawn(&pid_, NANOMAP_PYTHON, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(orders_read);
  close(output_write);
  orders_ = orders_write;
  output_ = output_read;
  if (failed != 0) throw std::runtime_error("cannot start " NANOMAP_PYTHON);

  constexpr auto kStart = std::chrono::seconds(30);  // Python starts slowly on a loaded machine
  const auto deadline = std::chrono::steady_clock::now() + kStart;
  while (events_.empty() && std::chrono::steady_clock::now() < deadline) read(std::chrono::milliseconds(100));
  if (events_.empty()) throw std::runtime_error(NANOMAP_AUTOPILOT " does not start");
  url_ = events_.front().at("url");
}

AutopilotProcess::~AutopilotProcess() {
  close(orders_);  // it ends with its input
  std::array<char, 65536> unread{};
  while (::read(output_, unread.data(), unread.size()) > 0) continue;
  close(output_);
  if (pid_ > 0) waitpid(pid_, nullptr, 0);
}

void AutopilotProcess::order(const std::string& line) const {
  const std::string text = line + "\n";
  if (write(orders_, text.data(), text.size()) < 0) throw std::runtime_error("the autopilot has died");
}

void AutopilotProcess::read(std::chrono::milliseconds wait) {
  pollfd ready{output_, POLLIN, 0};
  while (poll(&ready, 1, static_cast<int>(wait.count())) > 0) {
    std::array<char, 65536> buffer{};
    const ssize_t size = ::read(output_, buffer.data(), buffer.size());
    if (size <= 0) throw std::runtime_error("the autopilot has died");
    rest_.append(buffer.data(), static_cast<std::size_t>(size));
    for (std::size_t end = rest_.find('\n'); end != std::string::npos; end = rest_.find('\n')) {
      events_.push_back(nlohmann::json::parse(rest_.substr(0, end)));
      rest_.erase(0, end + 1);
    }
    wait = std::chrono::milliseconds(0);
  }
}

std::vector<nlohmann::json> AutopilotProcess::messages(const std::string& name) const {
  std::vector<nlohmann::json> messages;
  for (const nlohmann::json& event : events_) {
    if (event.at("event") == "message" && event.at("name") == name) messages.push_back(event);
  }
  return messages;
}

bool AutopilotProcess::saw(const std::string& event, const std::string& mode) const {
  for (const nlohmann::json& seen : events_) {
    if (seen.at("event") == event && seen.at("mode") == mode) return true;
  }
  return false;
}

}  // namespace nanomap::test
