#include "tools/doctor/gather_machine.h"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <system_error>

namespace nanomap::doctor {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFlightProgram = "nanomap-flight";

std::vector<VideoNode> videoNodes() {
  std::vector<VideoNode> nodes;
  std::error_code error;
  for (fs::directory_iterator entry("/dev", error), end; !error && entry != end; entry.increment(error)) {
    if (!entry->path().filename().string().starts_with("video")) continue;
    nodes.push_back({entry->path().string(), access(entry->path().c_str(), R_OK | W_OK) == 0});
  }
  std::ranges::sort(nodes, {}, &VideoNode::path);
  return nodes;
}

/// @param folder  may not be there yet
Disk diskOf(const std::string& folder) {
  Disk disk{.folder = folder};
  std::error_code error;
  fs::path there = fs::absolute(folder, error);
  while (!fs::exists(there, error) && there.has_relative_path()) there = there.parent_path();
  disk.writable = access(there.c_str(), W_OK) == 0;
  const fs::space_info space = fs::space(there, error);
  if (!error) disk.free_bytes = space.available;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    std::error_code no_file;
    const std::uintmax_t bytes = entry->file_size(no_file);
    if (!no_file) disk.recorded_bytes += bytes;
  }
  return disk;
}

}  // namespace

MachineFacts gatherMachine(const Configuration& configuration, const std::string& record) {
  constexpr int kAnyRealtimePriority = 1;
  MachineFacts machine;
  const std::vector<int> cores = gatherRealtimeFacts(kAnyRealtimePriority).cores;
  const ThreadLayout layout = configuration.layout.value_or(defaultLayout(cores));
  machine.realtime = gatherRealtimeFacts(layout.highestPriority());
  machine.realtime.program = fs::path(machine.realtime.program).replace_filename(kFlightProgram).string();
  try {
    checkLayout(layout, cores);
  } catch (const std::invalid_argument& error) {
    machine.layout_fault = error.what();
  }
  machine.video = videoNodes();
  if (!record.empty()) machine.disk = diskOf(record);
  return machine;
}

std::optional<int> receiveBufferLimit() {
  std::ifstream file("/proc/sys/net/core/rmem_max");
  int bytes = 0;
  if (!(file >> bytes)) return std::nullopt;
  return bytes;
}

}  // namespace nanomap::doctor
