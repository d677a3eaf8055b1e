#include "core/ring_buffer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <deque>
#include <memory>

namespace nanomap {
namespace {

/// Any sequence of operations leaves the ring equal to a deque that got the same.
RC_GTEST_PROP(RingBuffer, BehavesLikeABoundedDeque, ()) {
  const auto capacity = *rc::gen::inRange<std::size_t>(1, 9);
  RingBuffer<int> ring(capacity);
  std::deque<int> oracle;
  const auto operations = *rc::gen::container<std::vector<int>>(100, rc::gen::inRange(0, 5));
  int value = 0;
  for (const int operation : operations) {
    const bool room = oracle.size() < capacity;
    if (operation == 0 && room) {
      ring.pushBack(++value);
      oracle.push_back(value);
    } else if (operation == 1 && room) {
      ring.pushFront(++value);
      oracle.push_front(value);
    } else if (operation == 2 && !oracle.empty()) {
      ring.popFront();
      oracle.pop_front();
    } else if (operation == 3 && !oracle.empty()) {
      ring.popBack();
      oracle.pop_back();
    } else if (operation == 4 && room) {
      const auto at = *rc::gen::inRange<std::size_t>(0, oracle.size() + 1);
      ring.insert(at, ++value);
      oracle.insert(oracle.begin() + static_cast<std::ptrdiff_t>(at), value);
    }
    RC_ASSERT(ring.size() == oracle.size());
    RC_ASSERT(ring.full() == (oracle.size() == capacity));
    for (std::size_t i = 0; i < oracle.size(); ++i) RC_ASSERT(ring[i] == oracle[i]);
  }
}

TEST(RingBuffer, PoppedValuesReleaseWhatTheyOwn) {
  RingBuffer<std::shared_ptr<int>> ring(2);
  const auto owned = std::make_shared<int>(1);
  ring.pushBack(owned);
  ring.pushBack(owned);
  EXPECT_EQ(owned.use_count(), 3);
  ring.popFront();
  ring.popBack();
  EXPECT_EQ(owned.use_count(), 1);
}

}  // namespace
}  // namespace nanomap
