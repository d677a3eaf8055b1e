#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace nanomap {

/// Asked of the kernel unless the URL says otherwise: bursts of depth frames overflow the usual 208 KiB.
inline constexpr int kDefaultReceiveBufferBytes = 2 * 1024 * 1024;

/// An LCM network's address as liblcm takes it, with nothing left to liblcm's defaults.
struct LcmUrl {
  std::string text;
  /// Whether messages go through UDP multicast, udpm://GROUP:PORT; otherwise they stay in the object that publishes
  /// them, memq://.
  bool multicast = false;
  std::uint16_t port = 0;        ///< of UDP; 0 without multicast
  int receive_buffer_bytes = 0;  ///< to be asked of the kernel; 0 without multicast
};

/// Adds to udpm:// what it does not say: LCM's own group and port, ttl=0 (messages stay on this machine: whoever can
/// reach the group can inject poses), and recv_buf_size=kDefaultReceiveBufferBytes.
/// @throws std::invalid_argument naming the URL, what is wrong with it and what to write
[[nodiscard]] LcmUrl parseLcmUrl(std::string_view url);

}  // namespace nanomap
