#include <fmt/format.h>
#include <fmt/ranges.h>

#include "firmware_app/realtime/realtime_check.h"
#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kRealtime = "real time";
constexpr const char* kDisk = "disk";
constexpr std::uint64_t kMegabyte = 1'000'000;

}  // namespace

Findings checkRealtime(const MachineFacts& machine) {
  Findings findings;
  if (!machine.layout_fault.empty()) {
    findings.push_back(failure(kRealtime, "[realtime] does not fit this machine", machine.layout_fault));
  }
  std::string good_to_know;
  for (const RealtimeFinding& finding : judgeRealtime(machine.realtime, {})) {
    if (finding.refusal) {
      findings.push_back(failure(kRealtime, finding.reason, finding.fix));
    } else {
      good_to_know += " " + finding.reason;
    }
  }
  if (findings.empty()) {
    findings.push_back(
        ok(kRealtime, fmt::format("{} cores, SCHED_FIFO up to {}, memory can be locked.{}",
                                  machine.realtime.cores.size(), machine.realtime.tried_priority, good_to_know)));
  }
  return findings;
}

Findings checkDevices(const MachineFacts& machine) {
  std::vector<std::string> nodes;
  for (const VideoNode& node : machine.video) {
    nodes.push_back(node.path + (node.accessible ? "" : " (may not be opened by this user: group 'video')"));
  }
  return {notLookedAt("devices",
                      fmt::format("depth comes over LCM, no camera is opened; there is {}",
                                  nodes.empty() ? "no /dev/video*" : fmt::format("{}", fmt::join(nodes, ", "))))};
}

Findings checkDisk(const MachineFacts& machine, const RecorderParameters& recorder) {
  if (!machine.disk) return {notLookedAt(kDisk, "no folder was named: --record FOLDER, as for nanomap-flight")};
  const Disk& disk = *machine.disk;
  const std::uint64_t free_mb = disk.free_bytes / kMegabyte;
  const std::uint64_t total_mb = (disk.free_bytes + disk.recorded_bytes) / kMegabyte;
  const std::string seen = fmt::format("{}: {} MB free, {} MB recorded, recorder.total_mb = {}", disk.folder, free_mb,
                                       disk.recorded_bytes / kMegabyte, recorder.total_mb);
  if (!disk.writable) {
    return {failure(kDisk, fmt::format("{}: cannot be written to", disk.folder),
                    fmt::format("mkdir -p {0}, and chown it to the user that flies", disk.folder))};
  }
  if (free_mb < 2 * recorder.segment_mb) {
    return {failure(kDisk, seen + fmt::format(": not even two files of recorder.segment_mb = {}", recorder.segment_mb),
                    "free some space, or record elsewhere")};
  }
  if (total_mb < recorder.total_mb) {
    return {warning(kDisk, seen + ": it will be full before old flights are deleted",
                    fmt::format("recorder.total_mb = {}", total_mb / 10 * 9))};
  }
  return {ok(kDisk, seen)};
}

}  // namespace nanomap::doctor
