#include "drivers/lcm/lcm_network.h"

#include <poll.h>

#include <algorithm>
#include <ctime>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <stdexcept>
#include <utility>

#include "drivers/lcm/lcm_url.h"

namespace nanomap {
namespace {

constexpr std::string_view kMulticastRemedy =
    "Is there a route for multicast? On a machine without a network: 'ip link set lo multicast on' and 'ip route add "
    "224.0.0.0/4 dev lo'. Is a firewall in the way?";

void checkChannel(const std::string& channel) {
  if (channel.empty() || channel.size() > LCM_MAX_CHANNEL_NAME_LENGTH) {
    throw std::invalid_argument("LCM: the channel '" + channel + "' must have a name of 1 to " +
                                std::to_string(LCM_MAX_CHANNEL_NAME_LENGTH) + " bytes.");
  }
}

/// liblcm takes a channel for a regular expression.
std::string literally(const std::string& channel) {
  std::string pattern;
  for (const char c : channel) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    if (!plain) pattern += '\\';
    pattern += c;
  }
  return pattern;
}

bool becomesReadable(int descriptor, Duration timeout) {
  pollfd wanted{.fd = descriptor, .events = POLLIN, .revents = 0};
  const auto left = std::max(timeout, Duration::zero());
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(left);
  const timespec limit{.tv_sec = seconds.count(), .tv_nsec = (left - seconds).count()};
  return ppoll(&wanted, 1, &limit, nullptr) > 0;
}

}  // namespace

LcmNetwork::LcmNetwork(std::string_view url, std::vector<std::string> channels) {
  std::for_each(channels.begin(), channels.end(), checkChannel);
  std::sort(channels.begin(), channels.end());
  channels.erase(std::unique(channels.begin(), channels.end()), channels.end());
  std::transform(channels.begin(), channels.end(), channels.begin(), literally);
  connect(url, channels);
}

LcmNetwork::LcmNetwork(std::string_view url, EveryChannel /*channels*/) { connect(url, {".*"}); }

void LcmNetwork::connect(std::string_view url, const std::vector<std::string>& patterns) {
  const LcmUrl parsed = parseLcmUrl(url);
  url_ = parsed.text;
  const std::vector<int> sockets_of_others = parsed.multicast ? udpSocketsOn(parsed.port) : std::vector<int>();
  lcm_ = std::make_unique<lcm::LCM>(url_);
  if (!lcm_->good()) {
    throw std::runtime_error("LCM: cannot reach '" + url_ + "'. " + std::string(kMulticastRemedy));
  }
  if (patterns.empty()) return;
  notification_ = lcm_->getFileno();
  if (notification_ < 0) {
    throw std::runtime_error("LCM: cannot receive on '" + url_ + "': a message to ourselves did not arrive. " +
                             std::string(kMulticastRemedy));
  }
  subscribe(patterns);
  if (!parsed.multicast) return;

  std::vector<int> sockets = udpSocketsOn(parsed.port);
  std::vector<int> ours;
  std::set_difference(sockets.begin(), sockets.end(), sockets_of_others.begin(), sockets_of_others.end(),
                      std::back_inserter(ours));
  if (ours.empty()) return;
  receiver_.emplace(ours.front());
  if (const std::optional<int> granted = receiver_->bufferBytes()) {
    warning_ = receiveBufferWarning(parsed.receive_buffer_bytes, *granted);
  }
}

LcmNetwork::~LcmNetwork() = default;

void LcmNetwork::subscribe(const std::vector<std::string>& patterns) {
  for (const std::string& pattern : patterns) {
    lcm::Subscription* const subscription = lcm_->subscribe(pattern, &LcmNetwork::onMessage, this);
    subscription->setQueueCapacity(kMaxWaitingMessages);
    subscriptions_.push_back(subscription);
  }
}

MessageSource::Wait LcmNetwork::wait(Duration timeout, const Handler& handler) {
  if (!becomesReadable(notification_, timeout)) return Wait::kTimeout;
  noteFullQueues();
  handler_ = &handler;
  handled_ = false;
  // As many as can be there: a sender that never pauses must not keep us here.
  for (std::size_t left = subscriptions_.size() * kMaxWaitingMessages; left > 0; --left) {
    constexpr int kNow = 0;
    const int status = lcm_->handleTimeout(kNow);
    if (thrown_) std::rethrow_exception(std::exchange(thrown_, nullptr));
    if (status < 0) return Wait::kEnded;
    if (status == 0) break;
  }
  return handled_ ? Wait::kHandled : Wait::kTimeout;
}

void LcmNetwork::noteFullQueues() {
  for (const lcm::Subscription* subscription : subscriptions_) {
    if (subscription->getQueueSize() >= kMaxWaitingMessages) ++full_queues_;
  }
}

void LcmNetwork::onMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel) noexcept {
  handled_ = true;
  try {
    const auto* const data = static_cast<const std::uint8_t*>(buffer->data);
    (*handler_)({.channel = channel, .bytes = Bytes(data, buffer->data_size), .log_stamp = std::nullopt});
  } catch (...) {
    thrown_ = std::current_exception();
  }
}

bool LcmNetwork::publish(const std::string& channel, Bytes message) {
  if (message.size() > std::numeric_limits<unsigned int>::max()) return false;
  return lcm_->publish(channel, message.data(), static_cast<unsigned int>(message.size())) == 0;
}

LcmLoss LcmNetwork::loss() const {
  return {.datagrams = receiver_ ? receiver_->drops() : 0, .full_queues = full_queues_};
}

std::optional<int> LcmNetwork::receiveBufferBytes() const {
  return receiver_ ? receiver_->bufferBytes() : std::nullopt;
}

}  // namespace nanomap
