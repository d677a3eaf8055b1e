#include "firmware_app/realtime/realtime_check.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <system_error>
#include <utility>

#include "firmware_app/realtime/thread_layout.h"

namespace nanomap {
namespace {

using Finding = std::optional<RealtimeFinding>;

std::string milliseconds(Duration duration) {
  return std::to_string(std::chrono::duration_cast<std::chrono::milliseconds>(duration).count()) + " ms";
}

Finding judgeCores(const RealtimeFacts& facts, const RealtimeNeeds& needs) {
  if (facts.cores.size() >= needs.cores) return std::nullopt;
  return RealtimeFinding{
      .reason = "This process may use " + std::to_string(facts.cores.size()) + " of the machine's cores; it needs " +
                std::to_string(needs.cores) + ".",
      .fix =
          "Look for what keeps it from the others: taskset, CPUAffinity= of a systemd unit, --cpuset-cpus of a "
          "container, isolcpus= of the kernel."};
}

Finding judgeScheduling(const RealtimeFacts& facts) {
  if (facts.fifo_error == 0) return std::nullopt;
  const std::string wanted = "SCHED_FIFO with priority " + std::to_string(facts.tried_priority);
  if (facts.fifo_error != EPERM) {
    return RealtimeFinding{
        .reason = wanted + " fails: " + std::generic_category().message(facts.fifo_error) + ".",
        .fix = "Check that the kernel supports real-time scheduling, and the priorities in [realtime]."};
  }
  if (facts.may_schedule || facts.priority_limit >= static_cast<std::uint64_t>(std::max(facts.tried_priority, 0))) {
    return RealtimeFinding{
        .reason = wanted +
                  " is refused although the limit and the capabilities allow it: by a container's seccomp "
                  "filter, or since the control group has no real-time share (CONFIG_RT_GROUP_SCHED).",
        .fix =
            "Start a container with '--cap-add=SYS_NICE'; give the control group a share by cpu.rt_runtime_us, or "
            "boot with rt_group_sched=0."};
  }
  return RealtimeFinding{.reason = wanted + " is refused: RLIMIT_RTPRIO is " + std::to_string(facts.priority_limit) +
                                   ", and the process has no CAP_SYS_NICE.",
                         .fix = privilegeFix(facts.program)};
}

Finding judgeMemory(const RealtimeFacts& facts, const RealtimeNeeds& needs) {
  if (!needs.locked_memory || facts.may_lock_memory || !facts.locked_memory_limit_bytes) return std::nullopt;
  return RealtimeFinding{.reason = "Memory cannot be locked: RLIMIT_MEMLOCK is " +
                                   std::to_string(*facts.locked_memory_limit_bytes) +
                                   " bytes where it must be unlimited, and the process has no CAP_IPC_LOCK.",
                         .fix = privilegeFix(facts.program)};
}

Finding judgeThrottling(const RealtimeFacts& facts) {
  if (!facts.realtime_share || *facts.realtime_share >= facts.realtime_period) return std::nullopt;
  const bool never = *facts.realtime_share == Duration::zero();
  return RealtimeFinding{
      .refusal = never,
      .reason = "The kernel lets real-time threads run for " + milliseconds(*facts.realtime_share) + " of every " +
                milliseconds(facts.realtime_period) + " and no longer (kernel.sched_rt_runtime_us).",
      .fix = never ? "Run 'sysctl -w kernel.sched_rt_runtime_us=950000'."
                   : "Nothing to do while the stages take less; it keeps the machine reachable if one of them hangs."};
}

}  // namespace

std::vector<RealtimeFinding> judgeRealtime(const RealtimeFacts& facts, const RealtimeNeeds& needs) {
  std::vector<RealtimeFinding> findings;
  for (Finding& finding : std::array{judgeCores(facts, needs), judgeScheduling(facts), judgeMemory(facts, needs),
                                     judgeThrottling(facts)}) {
    if (finding) findings.push_back(std::move(*finding));
  }
  return findings;
}

bool grantsRealtime(std::span<const RealtimeFinding> findings) {
  return std::ranges::none_of(findings, &RealtimeFinding::refusal);
}

std::string toText(std::span<const RealtimeFinding> findings) {
  std::string text;
  for (const RealtimeFinding& finding : findings) text += finding.reason + "\n  " + finding.fix + "\n";
  return text;
}

std::string privilegeFix(const std::string& program) {
  const std::string priority = std::to_string(kInterruptPriority - 1);
  return "Start it by its systemd unit, nanomap-flight.service (LimitRTPRIO=" + priority +
         ", LimitMEMLOCK=infinity). Or write '@nanomap - rtprio " + priority +
         "' and '@nanomap - memlock unlimited' to /etc/security/limits.d/nanomap.conf, run 'usermod -aG nanomap USER' "
         "and log in again. Or run 'setcap cap_sys_nice,cap_ipc_lock=ep " +
         program + "'.";
}

}  // namespace nanomap
