#pragma once

#include <atomic>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/lcm/message_source.h"
#include "drivers/lcm/udp_receiver.h"

namespace lcm {
class LCM;
class Subscription;
struct ReceiveBuffer;
}  // namespace lcm

namespace nanomap {

/// Messages that a channel can have waiting, after which liblcm drops the newest: half a second of poses at 400 Hz.
/// What waited longer is of no use to a flight. Bounds what liblcm holds while nobody waits for messages.
inline constexpr int kMaxWaitingMessages = 200;

/// What is known to be lost since the start. liblcm itself counts nothing; gaps in stamps and sequence numbers tell
/// more.
struct LcmLoss {
  std::uint64_t datagrams =
      0;  ///< dropped by the kernel, since its buffer was full; a depth frame is up to ten of them
  std::uint64_t full_queues = 0;  ///< times that a channel was found with kMaxWaitingMessages: more may have been lost
};

/// In place of channels: all that there are, for tools that look at a network. They share one queue of
/// kMaxWaitingMessages.
struct EveryChannel {
  explicit constexpr EveryChannel(int /*unused*/) {}  // like std::nullopt_t, so that {} is a list without channels
};
inline constexpr EveryChannel kEveryChannel(0);

/// An LCM network, through liblcm. Receives on a thread of liblcm's, which is made here and inherits the scheduling of
/// the thread that does: construct it before real-time scheduling begins.
/// Threads: wait() from one; publish() and loss() from any.
class LcmNetwork : public MessageSource {
 public:
  /// Connects; with channels to listen to, it also waits until a message to itself arrives, up to 10 s.
  /// @param url       as parseLcmUrl() takes it
  /// @param channels  names, not patterns; those that occur twice count once; none: for publishing only
  /// @throws std::invalid_argument naming the URL or the channel; std::runtime_error naming the URL and what to do
  LcmNetwork(std::string_view url, std::vector<std::string> channels);

  /// The same, listening to whatever is sent.
  LcmNetwork(std::string_view url, EveryChannel channels);
  ~LcmNetwork() override;

  /// kEnded means that liblcm has failed. Allocates: what liblcm does. Reads no clock.
  [[nodiscard]] Wait wait(Duration timeout, const Handler& handler) override;

  /// Sends a message, in the time it takes to copy it to the kernel. False if the kernel or liblcm refused it; nothing
  /// says that a message arrived.
  [[nodiscard]] bool publish(const std::string& channel, Bytes message);

  [[nodiscard]] LcmLoss loss() const;

  /// What the kernel granted, of what was asked; empty without a UDP socket of ours to be found.
  [[nodiscard]] std::optional<int> receiveBufferBytes() const;

  /// The URL with nothing left to liblcm's defaults.
  [[nodiscard]] const std::string& url() const { return url_; }

  /// What lets messages get lost and how to mend it, for the start-up's report.
  [[nodiscard]] const std::optional<std::string>& warning() const { return warning_; }

 private:
  void onMessage(const lcm::ReceiveBuffer* buffer, const std::string& channel) noexcept;
  void connect(std::string_view url, const std::vector<std::string>& patterns);
  void subscribe(const std::vector<std::string>& patterns);
  void noteFullQueues();

  std::string url_;
  std::unique_ptr<lcm::LCM> lcm_;
  std::vector<lcm::Subscription*> subscriptions_;  ///< owned by lcm_
  int notification_ = -1;                          ///< liblcm's descriptor, readable when messages wait; -1: none ever
  std::optional<UdpReceiver> receiver_;            ///< empty without a UDP socket of ours to be found
  std::optional<std::string> warning_;
  std::atomic<std::uint64_t> full_queues_ = 0;

  // Within wait():
  const Handler* handler_ = nullptr;
  bool handled_ = false;
  std::exception_ptr thrown_;  ///< by the handler: C code lies between it and wait()
};

}  // namespace nanomap
