#include "firmware_app/handover/slot_queue.h"

#include <gmock/gmock.h>

#include <thread>
#include <vector>

namespace nanomap {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

template <class T>
bool pushValue(SlotQueue<T>& queue, const T& value) {
  return queue.push([&](T& slot) { slot = value; });
}

std::vector<int> drained(SlotQueue<int>& queue) {
  std::vector<int> values;
  while (queue.pop([&](int value) { values.push_back(value); })) {
  }
  return values;
}

TEST(SlotQueue, EmptyOneGivesNothing) {
  SlotQueue<int> queue(2);
  EXPECT_THAT(drained(queue), IsEmpty());
  EXPECT_EQ(queue.size(), 0U);
}

TEST(SlotQueue, GivesWhatWasPushedInThatOrder) {
  SlotQueue<int> queue(3);
  for (int value : {1, 2, 3}) EXPECT_TRUE(pushValue(queue, value));
  EXPECT_EQ(queue.size(), 3U);
  EXPECT_THAT(drained(queue), ElementsAre(1, 2, 3));
}

TEST(SlotQueue, HasRoomUntilItIsFullAndAgainOnceASlotIsBack) {
  SlotQueue<int> queue(1);
  EXPECT_TRUE(queue.hasRoom());
  pushValue(queue, 1);
  EXPECT_FALSE(queue.hasRoom());
  queue.pop([&](int) { EXPECT_FALSE(queue.hasRoom()) << "the slot is in use"; });
  EXPECT_TRUE(queue.hasRoom());
}

TEST(SlotQueue, FullOneDropsTheNewAndCounts) {
  SlotQueue<int> queue(2);
  for (int value : {1, 2}) EXPECT_TRUE(pushValue(queue, value));
  EXPECT_FALSE(pushValue(queue, 3));
  EXPECT_EQ(queue.dropped(), 1U);
  EXPECT_THAT(drained(queue), ElementsAre(1, 2));
  EXPECT_TRUE(pushValue(queue, 4));
  EXPECT_THAT(drained(queue), ElementsAre(4));
}

TEST(SlotQueue, SlotsKeepWhatTheyOwn) {
  SlotQueue<std::vector<int>> queue(1, std::vector<int>(100));
  const int* storage = nullptr;
  queue.push([&](std::vector<int>& slot) { storage = slot.data(); });
  queue.pop([](std::vector<int>&) {});
  queue.push([&](std::vector<int>& slot) { EXPECT_EQ(slot.data(), storage); });
}

TEST(SlotQueue, NothingIsLostOrTornBetweenTwoThreads) {
  struct Pair {
    std::uint64_t value = 0;
    std::uint64_t inverse = 0;
  };
  constexpr std::uint64_t kCount = 200'000;
  SlotQueue<Pair> queue(16);
  std::thread producer([&] {
    for (std::uint64_t value = 1; value <= kCount;) {
      if (queue.push([&](Pair& slot) { slot = {value, ~value}; })) {
        ++value;
      } else {
        std::this_thread::yield();
      }
    }
  });
  std::uint64_t expected = 1;
  std::uint64_t wrong = 0;
  while (expected <= kCount) {
    const bool popped =
        queue.pop([&](const Pair& pair) { wrong += pair.value != expected || pair.inverse != ~expected; });
    if (popped) {
      ++expected;
    } else {
      std::this_thread::yield();
    }
  }
  producer.join();
  EXPECT_EQ(wrong, 0U);
  EXPECT_EQ(queue.size(), 0U);
}

}  // namespace
}  // namespace nanomap
