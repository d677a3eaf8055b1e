#include "firmware_app/recorder/message_tap.h"

#include <gmock/gmock.h>

#include <string>
#include <thread>

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr Time at(std::int64_t us) { return Time(std::chrono::microseconds(us)); }

struct Popped {
  std::string channel;
  Time arrival{};
  std::vector<std::uint8_t> message;

  bool operator==(const Popped&) const = default;
};

std::vector<Popped> drained(MessageTap& tap) {
  std::vector<Popped> all;
  while (tap.pop([&](std::string_view channel, Time arrival, Bytes message) {
    all.push_back({std::string(channel), arrival, {message.begin(), message.end()}});
  })) {
  }
  return all;
}

const std::vector<std::uint8_t> kMessage = {1, 2, 3, 4};

TEST(MessageTap, EmptyOneGivesNothing) {
  MessageTap tap(4, 100);
  EXPECT_THAT(drained(tap), IsEmpty());
}

TEST(MessageTap, MessagesComeOutAsTheyWentIn) {
  MessageTap tap(4, 100);
  const std::string longest(kMaxChannelBytes, 'x');
  EXPECT_TRUE(tap.push("POSE", at(1), kMessage));
  EXPECT_TRUE(tap.push(longest, at(2), {}));
  EXPECT_TRUE(tap.push("POSE", at(2), Bytes(kMessage).first(1)));
  EXPECT_THAT(drained(tap),
              ElementsAre(Popped{"POSE", at(1), kMessage}, Popped{longest, at(2), {}}, Popped{"POSE", at(2), {1}}));
}

TEST(MessageTap, MessageThatFindsNoRoomIsDroppedWholeAndCounted) {
  MessageTap bytes(10, 6);
  EXPECT_TRUE(bytes.push("A", at(1), kMessage));
  EXPECT_FALSE(bytes.push("A", at(2), kMessage));
  EXPECT_TRUE(bytes.push("A", at(3), Bytes(kMessage).first(2)));
  EXPECT_EQ(bytes.dropped(), 1U);
  EXPECT_THAT(drained(bytes), ElementsAre(Popped{"A", at(1), kMessage}, Popped{"A", at(3), {1, 2}}));
  EXPECT_TRUE(bytes.push("A", at(4), kMessage));
  EXPECT_THAT(drained(bytes), ElementsAre(Popped{"A", at(4), kMessage}));

  MessageTap messages(1, 100);
  EXPECT_TRUE(messages.push("A", at(1), kMessage));
  EXPECT_FALSE(messages.push("A", at(2), kMessage));
  EXPECT_EQ(messages.dropped(), 1U);
  EXPECT_THAT(drained(messages), ElementsAre(Popped{"A", at(1), kMessage}));
}

TEST(MessageTap, ChannelThatNoLogCanHoldIsDropped) {
  MessageTap tap(4, 100);
  EXPECT_FALSE(tap.push(std::string(kMaxChannelBytes + 1, 'x'), at(1), kMessage));
  EXPECT_EQ(tap.dropped(), 1U);
}

TEST(MessageTap, NothingIsTornOrLostUncountedBetweenTwoThreads) {
  constexpr std::int64_t kCount = 100'000;
  MessageTap tap(16, 300);
  std::int64_t pushed = 0;
  std::jthread producer([&] {
    std::vector<std::uint8_t> message;
    for (std::int64_t i = 1; i <= kCount; ++i) {
      message.assign(static_cast<std::size_t>(i % 61), static_cast<std::uint8_t>(i % 251));
      if (tap.push("POSE", at(i), message)) ++pushed;
    }
  });
  std::int64_t popped = 0;
  std::int64_t last = 0;
  const auto check = [&](std::string_view, Time arrival, Bytes message) {
    const std::int64_t i = arrival.time_since_epoch() / std::chrono::microseconds(1);
    ++popped;
    ASSERT_GT(i, last);
    last = i;
    ASSERT_EQ(message.size(), static_cast<std::size_t>(i % 61));
    for (const std::uint8_t byte : message) ASSERT_EQ(byte, i % 251);
  };
  while (popped + static_cast<std::int64_t>(tap.dropped()) < kCount && !HasFatalFailure()) {
    if (!tap.pop(check)) std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(popped, pushed);
  EXPECT_EQ(popped + static_cast<std::int64_t>(tap.dropped()), kCount);
}

}  // namespace
}  // namespace nanomap
