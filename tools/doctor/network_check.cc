#include <fmt/format.h>

#include "drivers/lcm/udp_receiver.h"
#include "tools/doctor/checks.h"

namespace nanomap::doctor {
namespace {

constexpr const char* kBuffer = "receive buffer";

Finding judgeReach(const std::string& url) {
  const std::size_t found = url.find("ttl=");
  const bool leaves = found != std::string::npos && url[found + 4] != '0';
  if (!leaves) return ok("network", url + ": stays on this machine");
  return warning("network", url + ": leaves this machine, and whoever is on the network can send poses",
                 "lcm.url = \"...?ttl=0\", unless a sender is on another machine");
}

Finding judgeBuffer(const ReceiveBuffer& buffer) {
  const int limit_bytes = buffer.limit_bytes.value_or(buffer.wanted_bytes);
  const int granted_bytes = buffer.granted_bytes.value_or(limit_bytes);
  if (const auto reason = receiveBufferWarning(buffer.wanted_bytes, std::min(granted_bytes, limit_bytes))) {
    return failure(kBuffer,
                   fmt::format("{} of {} bytes are granted, net.core.rmem_max is {}: bursts of depth frames get lost",
                               granted_bytes, buffer.wanted_bytes, limit_bytes),
                   fmt::format("sysctl -w net.core.rmem_max={0}; to keep it, 'net.core.rmem_max = {0}' in "
                               "/etc/sysctl.d/nanomap.conf",
                               buffer.wanted_bytes));
  }
  if (buffer.lost.value_or(0) > 0) {
    return warning(kBuffer,
                   fmt::format("{} datagrams were lost while listening, with {} bytes", *buffer.lost, granted_bytes),
                   "lcm.url: recv_buf_size=8388608, and net.core.rmem_max likewise");
  }
  return ok(kBuffer, fmt::format("{} bytes, as wanted; net.core.rmem_max is {}", granted_bytes, limit_bytes));
}

}  // namespace

Findings checkNetwork(const Facts& facts) {
  Findings findings;
  if (facts.lcm_fault.empty()) {
    findings.push_back(judgeReach(facts.configuration.lcm.url));
  } else {
    findings.push_back(failure("network", "nothing can be heard", facts.lcm_fault));
  }
  if (facts.receive_buffer) findings.push_back(judgeBuffer(*facts.receive_buffer));
  return findings;
}

}  // namespace nanomap::doctor
