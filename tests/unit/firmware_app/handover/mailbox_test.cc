#include "firmware_app/handover/mailbox.h"

#include <gtest/gtest.h>

#include <optional>
#include <thread>
#include <vector>

namespace nanomap {
namespace {

template <class T>
void putValue(Mailbox<T>& mailbox, const T& value) {
  mailbox.put([&](T& slot) { slot = value; });
}

std::optional<int> taken(Mailbox<int>& mailbox) {
  std::optional<int> value;
  mailbox.take([&](int newest) { value = newest; });
  return value;
}

TEST(Mailbox, EmptyOneGivesNothing) {
  Mailbox<int> mailbox;
  EXPECT_EQ(taken(mailbox), std::nullopt);
}

TEST(Mailbox, GivesEachValueOnce) {
  Mailbox<int> mailbox;
  putValue(mailbox, 7);
  EXPECT_EQ(taken(mailbox), 7);
  EXPECT_EQ(taken(mailbox), std::nullopt);
}

TEST(Mailbox, NewestWinsAndTheOthersAreCounted) {
  Mailbox<int> mailbox;
  for (int value = 1; value <= 5; ++value) putValue(mailbox, value);
  EXPECT_EQ(taken(mailbox), 5);
  EXPECT_EQ(mailbox.replaced(), 4U);
}

TEST(Mailbox, TakerKeepsItsSlotWhileOthersArePut) {
  Mailbox<int> mailbox;
  putValue(mailbox, 1);
  mailbox.take([&](const int& held) {
    for (int value = 2; value <= 9; ++value) putValue(mailbox, value);
    EXPECT_EQ(held, 1);
  });
  EXPECT_EQ(taken(mailbox), 9);
}

TEST(Mailbox, ThreeSlotsGoRound) {
  Mailbox<std::vector<int>> mailbox(std::vector<int>(10));
  std::vector<const int*> storages;
  for (int i = 0; i < 9; ++i) {
    mailbox.put([&](std::vector<int>& slot) { storages.push_back(slot.data()); });
    mailbox.take([](std::vector<int>&) {});
  }
  for (std::size_t i = 3; i < storages.size(); ++i) EXPECT_EQ(storages[i], storages[i - 3]);
}

TEST(Mailbox, NeverGivesATornOrAnOlderValueToAnotherThread) {
  struct Pair {
    std::uint64_t value = 0;
    std::uint64_t inverse = ~std::uint64_t{0};
  };
  constexpr std::uint64_t kCount = 200'000;
  Mailbox<Pair> mailbox;
  std::thread producer([&] {
    for (std::uint64_t value = 1; value <= kCount; ++value) {
      mailbox.put([&](Pair& slot) { slot = {value, ~value}; });
      if (value % 64 == 0) std::this_thread::yield();
    }
  });
  std::uint64_t last = 0;
  std::uint64_t takes = 0;
  std::uint64_t wrong = 0;
  while (last < kCount) {
    const bool taken = mailbox.take([&](const Pair& pair) {
      wrong += pair.value <= last || pair.inverse != ~pair.value;
      last = pair.value;
    });
    takes += taken;
    if (!taken) std::this_thread::yield();
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(takes + mailbox.replaced(), kCount);
}

}  // namespace
}  // namespace nanomap
