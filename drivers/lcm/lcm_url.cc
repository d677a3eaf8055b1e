#include "drivers/lcm/lcm_url.h"

#include <charconv>
#include <limits>
#include <optional>
#include <stdexcept>

namespace nanomap {
namespace {

constexpr std::string_view kMulticast = "udpm://";
constexpr std::string_view kInProcess = "memq://";
constexpr std::string_view kDefaultGroup = "239.255.76.67";
constexpr int kDefaultPort = 7667;
constexpr int kStayOnThisMachine = 0;

[[noreturn]] void refuse(std::string_view url, const std::string& why) {
  throw std::invalid_argument("LCM: the URL '" + std::string(url) + "' " + why +
                              ". Write udpm://239.255.76.67:7667?ttl=0, with the group and port of those you talk to.");
}

int toNumber(std::string_view url, std::string_view name, std::string_view text, int min, int max) {
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < min || value > max) {
    refuse(url, "has the " + std::string(name) + " '" + std::string(text) + "', which is no number from " +
                    std::to_string(min) + " to " + std::to_string(max));
  }
  return value;
}

/// Cuts `text` at the first of `separators`: returns what stands before it and leaves what stands behind.
std::string_view takeUntil(std::string_view& text, std::string_view separators) {
  const std::size_t end = text.find_first_of(separators);
  const std::string_view taken = text.substr(0, end);
  text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  return taken;
}

}  // namespace

LcmUrl parseLcmUrl(std::string_view url) {
  if (url == kInProcess) return {.text = std::string(url)};
  if (url.starts_with("file://")) refuse(url, "is a log, not a network: give the log as the source of messages");
  if (!url.starts_with(kMulticast)) refuse(url, "names no network that is known here");

  std::string_view options = url.substr(kMulticast.size());
  std::string_view place = takeUntil(options, "?");
  std::string_view group = takeUntil(place, ":");
  if (group.empty()) group = kDefaultGroup;
  const int port =
      place.empty() ? kDefaultPort : toNumber(url, "port", place, 1, std::numeric_limits<std::uint16_t>::max());

  std::optional<int> ttl;
  std::optional<int> receive_buffer_bytes;
  while (!options.empty()) {
    std::string_view value = takeUntil(options, "&,");
    const std::string_view name = takeUntil(value, "=");
    if (name == "ttl") {
      ttl = toNumber(url, name, value, kStayOnThisMachine, std::numeric_limits<std::uint8_t>::max());
    } else if (name == "recv_buf_size") {
      receive_buffer_bytes = toNumber(url, name, value, 1, std::numeric_limits<int>::max());
    } else {
      refuse(url,
             "has the option '" + std::string(name) + "', which LCM does not know; it knows ttl and recv_buf_size");
    }
  }

  LcmUrl parsed;
  parsed.multicast = true;
  parsed.port = static_cast<std::uint16_t>(port);
  parsed.receive_buffer_bytes = receive_buffer_bytes.value_or(kDefaultReceiveBufferBytes);
  parsed.text = std::string(kMulticast) + std::string(group) + ":" + std::to_string(port) +
                "?ttl=" + std::to_string(ttl.value_or(kStayOnThisMachine)) +
                "&recv_buf_size=" + std::to_string(parsed.receive_buffer_bytes);
  return parsed;
}

}  // namespace nanomap
