#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nanomap {

/// File descriptors of this process's UDP sockets that are bound to `port`, ascending. None where /proc is missing.
[[nodiscard]] std::vector<int> udpSocketsOn(std::uint16_t port);

/// What the kernel does with datagrams for a socket that somebody else, liblcm, opened and reads.
/// Threads: any. Allocates: no.
class UdpReceiver {
 public:
  /// @param socket  a UDP socket, open for as long as this is used
  explicit UdpReceiver(int socket) : socket_(socket) {}

  /// Bytes of datagrams that it holds before it drops, as SO_RCVBUF takes them; empty if the kernel does not say.
  [[nodiscard]] std::optional<int> bufferBytes() const;

  /// Datagrams dropped because the buffer was full: the kernel's 32-bit counter, the "drops" of /proc/net/udp.
  [[nodiscard]] std::uint32_t drops() const;

 private:
  int socket_;
};

/// What to tell and to do if the kernel granted less than was asked for; empty if all is well.
[[nodiscard]] std::optional<std::string> receiveBufferWarning(int wanted_bytes, int granted_bytes);

}  // namespace nanomap
