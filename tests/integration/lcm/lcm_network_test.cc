#include "drivers/lcm/lcm_network.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "tests/integration/lcm/network.h"

namespace nanomap::test {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Optional;
using ::testing::ThrowsMessage;
using Wait = MessageSource::Wait;

class LcmNetworkTest : public MulticastTest {
 protected:
  void send(LcmNetwork& network, const std::string& channel, const std::string& text) {
    EXPECT_TRUE(network.publish(channel, bytesOf(text)));
  }
};

/// The lines of /proc/net/udp for sockets on a port, as words.
std::vector<std::vector<std::string>> socketsOn(int port) {
  std::ifstream table("/proc/net/udp");
  std::string line;
  std::getline(table, line);  // titles
  std::vector<std::vector<std::string>> sockets;
  while (std::getline(table, line)) {
    std::istringstream fields(line);
    const std::vector<std::string> words{std::istream_iterator<std::string>(fields), {}};
    const std::string& address = words.at(1);
    if (std::stoi(address.substr(address.find(':') + 1), nullptr, 16) == port) sockets.push_back(words);
  }
  return sockets;
}

std::uint64_t dropsOn(int port) {
  std::uint64_t sum = 0;
  for (const auto& socket : socketsOn(port)) sum += std::stoull(socket.back());
  return sum;
}

/// Until liblcm's thread has taken all datagrams from the kernel.
void untilReceived(int port) {
  const auto hasDatagrams = [](const std::vector<std::string>& socket) { return !socket.at(4).ends_with(":00000000"); };
  while (std::ranges::any_of(socketsOn(port), hasDatagrams)) std::this_thread::yield();
}

TEST_F(LcmNetworkTest, CarriesMessagesOfOneByteAndOfManyDatagrams) {
  LcmNetwork receiver(url(), {"A", "B"});
  LcmNetwork sender(url(), {});
  const std::string frame(640 * 480 * 2, '.');
  send(sender, "A", "");
  send(sender, "B", "x");
  send(sender, "A", frame);
  hear(receiver, 3);
  EXPECT_THAT(heard_, ElementsAre("A:", "B:x", "A:" + frame));
}

TEST_F(LcmNetworkTest, HearsItsOwnMessagesToo) {
  LcmNetwork network(url(), {"A"});
  send(network, "A", "me");
  hear(network, 1);
  EXPECT_THAT(heard_, ElementsAre("A:me"));
}

TEST_F(LcmNetworkTest, HearsOnlyItsChannelsAndTakesTheirNamesLiterally) {
  LcmNetwork receiver(url(), {"A.B", "(C)*", "A.B"});
  LcmNetwork sender(url(), {});
  for (const char* channel : {"AxB", "CC", "", "A.BC", "A.B", "(C)*"}) send(sender, channel, "");
  hear(receiver, 2);
  EXPECT_THAT(heard_, ElementsAre("A.B:", "(C)*:"));
}

TEST_F(LcmNetworkTest, HearsEveryChannelIfAskedTo) {
  LcmNetwork receiver(url(), kEveryChannel);
  LcmNetwork sender(url(), {});
  EXPECT_GE(receiver.receiveBufferBytes(), 1);
  EXPECT_EQ(sender.receiveBufferBytes(), std::nullopt);
  for (const char* channel : {"A", "B.C", "(D)*"}) send(sender, channel, "");
  hear(receiver, 3);
  EXPECT_THAT(heard_, ElementsAre("A:", "B.C:", "(D)*:"));
}

TEST_F(LcmNetworkTest, WaitsNoLongerThanItMay) {
  LcmNetwork network(url(), {"A"});
  const auto start = std::chrono::steady_clock::now();
  EXPECT_EQ(network.wait(20ms, [](const ReceivedMessage&) {}), Wait::kTimeout);
  EXPECT_GE(std::chrono::steady_clock::now() - start, 20ms);
  EXPECT_EQ(network.wait(-1s, [](const ReceivedMessage&) {}), Wait::kTimeout);
}

TEST_F(LcmNetworkTest, WithoutChannelsOnlyPublishes) {
  LcmNetwork network(url(), {});
  send(network, "A", "x");
  EXPECT_EQ(network.wait(1ms, [](const ReceivedMessage&) {}), Wait::kTimeout);
  EXPECT_EQ(network.loss().datagrams, 0U);
}

TEST_F(LcmNetworkTest, HandlerThatThrowsLosesOnlyItsOwnMessage) {
  LcmNetwork network(url(), {"A"});
  send(network, "A", "one");
  send(network, "A", "two");
  const auto fail = [](const ReceivedMessage&) { throw std::runtime_error("no"); };
  EXPECT_THROW((void)network.wait(10s, fail), std::runtime_error);
  hear(network, 1);
  EXPECT_THAT(heard_, ElementsAre("A:two"));
}

TEST_F(LcmNetworkTest, FullQueueIsNoticed) {
  LcmNetwork network(url(), {"A"});
  constexpr int kRoom = 10;  // the last datagram may be on its way through liblcm
  for (int i = 0; i < kMaxWaitingMessages - kRoom; ++i) send(network, "A", "");
  untilReceived(port());
  hear(network, kMaxWaitingMessages - kRoom);
  EXPECT_EQ(network.loss().full_queues, 0U);

  heard_.clear();
  for (int i = 0; i < kMaxWaitingMessages + kRoom; ++i) send(network, "A", std::to_string(i));
  untilReceived(port());
  hear(network, kMaxWaitingMessages);
  ASSERT_EQ(heard_.size(), static_cast<std::size_t>(kMaxWaitingMessages));
  EXPECT_EQ(heard_.back(), "A:" + std::to_string(kMaxWaitingMessages - 1)) << "the newest are lost";
  EXPECT_EQ(network.loss().full_queues, 1U);
}

TEST_F(LcmNetworkTest, CountsWhatTheKernelDrops) {
  LcmNetwork receiver(url() + "?recv_buf_size=1", {"A"});  // the least that the kernel grants: about one datagram
  LcmNetwork sender(url(), {});
  constexpr std::size_t kBurst = 100;
  constexpr std::size_t kDatagram = 50'000;
  std::size_t sent = 0;
  for (int round = 0; round < 100 && receiver.loss().datagrams == 0; ++round) {
    for (std::size_t i = 0; i < kBurst; ++i) send(sender, "A", std::string(kDatagram, '.'));
    sent += kBurst;
    untilReceived(port());
    hear(receiver, sent - receiver.loss().datagrams);
  }
  EXPECT_GT(receiver.loss().datagrams, 0U);
  EXPECT_EQ(receiver.loss().datagrams, dropsOn(port()));
  EXPECT_EQ(heard_.size() + receiver.loss().datagrams, sent);
  EXPECT_EQ(receiver.loss().full_queues, 0U);
}

TEST_F(LcmNetworkTest, WarnsOfASmallReceiveBuffer) {
  EXPECT_EQ(LcmNetwork(url() + "?recv_buf_size=4096", {"A"}).warning(), std::nullopt);
  const LcmNetwork network(url() + "?recv_buf_size=1000000000", {"A"});
  EXPECT_THAT(network.warning(), Optional(HasSubstr("net.core.rmem_max=1000000000")));
}

TEST_F(LcmNetworkTest, ListenersOnOnePortAreToldApart) {
  const LcmNetwork large(url(), {"A"});
  const LcmNetwork small(url() + "?recv_buf_size=1", {"B"});
  LcmNetwork sender(url(), {});
  for (int round = 0; round < 1000 && small.loss().datagrams == 0; ++round) {
    for (int i = 0; i < 10; ++i) send(sender, "B", std::string(50'000, '.'));  // a quarter of the large buffer
    untilReceived(port());
  }
  EXPECT_GT(small.loss().datagrams, 0U);
  EXPECT_EQ(large.loss().datagrams, 0U);
}

TEST(LcmNetwork, WithinTheProcessCarriesMessagesToo) {
  LcmNetwork network("memq://", {"A"});
  for (const char* text : {"1", "2", "3"}) EXPECT_TRUE(network.publish("A", bytesOf(text)));
  std::string heard;
  EXPECT_EQ(network.wait(0s, [&](const ReceivedMessage& message) { heard += static_cast<char>(message.bytes[0]); }),
            Wait::kHandled);
  EXPECT_EQ(heard, "123");
  EXPECT_EQ(network.loss().datagrams, 0U);
  EXPECT_EQ(network.warning(), std::nullopt);
}

TEST(LcmNetwork, ChannelWithoutANameIsRefused) {
  EXPECT_THAT([] { LcmNetwork("memq://", {""}); }, ThrowsMessage<std::invalid_argument>(HasSubstr("channel ''")));
  const std::string long_name(64, 'A');
  EXPECT_THAT([&] { LcmNetwork("memq://", {long_name}); }, ThrowsMessage<std::invalid_argument>(HasSubstr(long_name)));
}

TEST(LcmNetwork, MachineWithoutARouteIsToldWhatToDo) {
  // A network namespace of its own has no route at all; it ends with the thread.
  std::string message;
  bool allowed = true;
  std::thread([&] {
    allowed = unshare(CLONE_NEWNET) == 0;
    if (!allowed) return;
    try {
      const LcmNetwork network("udpm://239.255.76.67:7667", {"A"});
    } catch (const std::runtime_error& error) {
      message = error.what();
    }
  }).join();
  if (!allowed) GTEST_SKIP() << "only root may try a machine without a network";
  EXPECT_THAT(message, AllOf(HasSubstr("udpm://239.255.76.67:7667"), HasSubstr("ip link set lo multicast on"),
                             HasSubstr("ip route add 224.0.0.0/4 dev lo")));
}

}  // namespace
}  // namespace nanomap::test
