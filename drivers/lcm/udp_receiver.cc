#include "drivers/lcm/udp_receiver.h"

#include <linux/sock_diag.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <system_error>

namespace nanomap {
namespace {

bool isUdpOn(int descriptor, std::uint16_t port) {
  int type = 0;
  socklen_t size = sizeof type;
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) return false;
  sockaddr_in address{};
  size = sizeof address;
  if (getsockname(descriptor, static_cast<sockaddr*>(static_cast<void*>(&address)), &size) != 0) return false;
  return address.sin_family == AF_INET && ntohs(address.sin_port) == port;
}

}  // namespace

std::vector<int> udpSocketsOn(std::uint16_t port) {
  std::vector<int> sockets;
  std::error_code error;
  for (std::filesystem::directory_iterator entry("/proc/self/fd", error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    int descriptor = -1;
    std::from_chars(name.data(), name.data() + name.size(), descriptor);
    if (isUdpOn(descriptor, port)) sockets.push_back(descriptor);
  }
  std::sort(sockets.begin(), sockets.end());
  return sockets;
}

std::optional<int> UdpReceiver::bufferBytes() const {
  int bytes = 0;
  socklen_t size = sizeof bytes;
  if (getsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &bytes, &size) != 0) return std::nullopt;
  return bytes / 2;  // socket(7): the kernel doubles the value that it is given, and tells the double
}

std::uint32_t UdpReceiver::drops() const {
  std::array<std::uint32_t, SK_MEMINFO_VARS> memory{};
  socklen_t size = sizeof memory;
  if (getsockopt(socket_, SOL_SOCKET, SO_MEMINFO, memory.data(), &size) != 0) return 0;
  return memory[SK_MEMINFO_DROPS];
}

std::optional<std::string> receiveBufferWarning(int wanted_bytes, int granted_bytes) {
  if (granted_bytes >= wanted_bytes) return std::nullopt;
  const std::string wanted = std::to_string(wanted_bytes);
  return "LCM: the kernel grants " + std::to_string(granted_bytes) + " of " + wanted +
         " bytes for receiving, so that bursts of depth frames will be lost. Run 'sysctl -w net.core.rmem_max=" +
         wanted + "', and write that setting to a file in /etc/sysctl.d to keep it.";
}

}  // namespace nanomap
