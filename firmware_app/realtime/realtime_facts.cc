#include "firmware_app/realtime/realtime_facts.h"

#include <linux/capability.h>
#include <pthread.h>
#include <sched.h>
#include <sys/resource.h>

#include <charconv>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <thread>

namespace nanomap {
namespace {

std::string textOf(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

std::optional<std::int64_t> numberIn(const char* path) {
  std::ifstream file(path);
  std::int64_t number = 0;
  if (!(file >> number)) return std::nullopt;
  return number;
}

std::vector<int> usableCores() {
  std::vector<int> cores;
  cpu_set_t set;
  CPU_ZERO(&set);
  constexpr pid_t kSelf = 0;
  if (sched_getaffinity(kSelf, sizeof set, &set) != 0) return cores;
  for (int core = 0; core < CPU_SETSIZE; ++core) {
    if (CPU_ISSET(static_cast<std::size_t>(core), &set)) cores.push_back(core);
  }
  return cores;
}

int tryFifo(int priority) {
  int error = 0;
  std::thread([&] {
    sched_param parameters{};
    parameters.sched_priority = priority;
    error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters);
  }).join();
  return error;
}

std::optional<std::uint64_t> softLimit(__rlimit_resource_t resource) {
  rlimit limit{};
  if (getrlimit(resource, &limit) != 0) return 0;
  if (limit.rlim_cur == RLIM_INFINITY) return std::nullopt;
  return limit.rlim_cur;
}

}  // namespace

RealtimeFacts gatherRealtimeFacts(int priority) {
  RealtimeFacts facts;
  facts.cores = usableCores();
  facts.tried_priority = priority;
  facts.fifo_error = tryFifo(priority);
  facts.priority_limit =
      softLimit(RLIMIT_RTPRIO).value_or(static_cast<std::uint64_t>(sched_get_priority_max(SCHED_FIFO)));
  facts.locked_memory_limit_bytes = softLimit(RLIMIT_MEMLOCK);
  const std::string status = textOf("/proc/self/status");
  facts.may_schedule = hasCapability(status, CAP_SYS_NICE);
  facts.may_lock_memory = hasCapability(status, CAP_IPC_LOCK);
  const auto runtime_us = numberIn("/proc/sys/kernel/sched_rt_runtime_us");
  if (runtime_us && *runtime_us >= 0) facts.realtime_share = std::chrono::microseconds(*runtime_us);
  facts.realtime_period = std::chrono::microseconds(numberIn("/proc/sys/kernel/sched_rt_period_us").value_or(0));
  facts.program = programPath();
  return facts;
}

std::string programPath() {
  std::error_code ignored;
  return std::filesystem::read_symlink("/proc/self/exe", ignored);
}

bool hasCapability(std::string_view status, int bit) {
  constexpr std::string_view kKey = "CapEff:\t";
  constexpr int kHexadecimal = 16;
  const std::size_t start = status.find(kKey);
  if (start == std::string_view::npos) return false;
  const std::string_view text = status.substr(start + kKey.size());
  std::uint64_t capabilities = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), capabilities, kHexadecimal);
  return error == std::errc() && ((capabilities >> static_cast<unsigned>(bit)) & 1U) != 0;
}

}  // namespace nanomap
