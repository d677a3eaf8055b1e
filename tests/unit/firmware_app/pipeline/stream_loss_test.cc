#include "firmware_app/pipeline/stream_loss.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <utility>
#include <vector>

namespace nanomap {
namespace {

using namespace std::chrono_literals;

constexpr Duration kPeriod = 10ms;

/// A publisher that began at 1 s, and numbers its messages from 0 or not at all.
Time stampOf(std::uint64_t number) { return Time(1s + static_cast<std::int64_t>(number) * kPeriod); }

StreamLoss numbered(const std::vector<std::uint64_t>& numbers) {
  NumberedStream stream;
  for (const std::uint64_t number : numbers) stream.arrived(number, stampOf(number));
  return stream.loss();
}

StreamLoss stamped(const std::vector<std::uint64_t>& numbers) {
  StampedStream stream;
  for (const std::uint64_t number : numbers) stream.arrived(stampOf(number));
  return stream.loss();
}

std::vector<std::uint64_t> upTo(std::uint64_t end) {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t i = 0; i < end; ++i) numbers.push_back(i);
  return numbers;
}

TEST(NumberedStream, LosesNothingOfNoneOneOrAll) {
  EXPECT_EQ(numbered({}).lost(), 0U);
  EXPECT_EQ(numbered({7}).lost(), 0U) << "who joins late has lost nothing";
  EXPECT_EQ(numbered(upTo(500)).lost(), 0U);
}

TEST(NumberedStream, CountsGaps) {
  EXPECT_EQ(numbered({0, 1, 3, 4, 9}).missing, 5U);
  EXPECT_EQ(numbered({0, 200}).missing, 199U);
}

TEST(NumberedStream, CountsWhatComesAgainOnce) {
  const StreamLoss loss = numbered({0, 1, 1, 2, 1});
  EXPECT_EQ(loss.repeated, 2U);
  EXPECT_EQ(loss.lost(), 0U);
}

TEST(NumberedStream, WhatComesLateIsMissingNoLonger) {
  const StreamLoss loss = numbered({0, 3, 2, 1, 4, 1});
  EXPECT_EQ(loss.missing, 0U);
  EXPECT_EQ(loss.late, 2U);
  EXPECT_EQ(loss.repeated, 1U);
}

TEST(NumberedStream, WhatComesMuchTooLateStaysMissing) {
  const StreamLoss loss = numbered({0, 2, 100, 1});
  EXPECT_EQ(loss.missing, 98U);
  EXPECT_EQ(loss.late, 1U);
}

TEST(NumberedStream, PublisherThatStartsAnewHasLostNothing) {
  NumberedStream stream;
  for (std::uint64_t i = 1'000'000; i < 1'000'010; ++i) stream.arrived(i, stampOf(i));
  stream.arrived(0, stampOf(1'000'500));
  stream.arrived(1, stampOf(1'000'501));
  stream.arrived(3, stampOf(1'000'503));
  EXPECT_EQ(stream.loss().began_again, 1U);
  EXPECT_EQ(stream.loss().missing, 1U);
  stream.arrived(5'000'000, stampOf(1'000'504));
  EXPECT_EQ(stream.loss().began_again, 2U) << "and none that goes on with another count";
  EXPECT_EQ(stream.loss().missing, 1U);
}

TEST(NumberedStream, LogThatIsPlayedAgainHasLostNothing) {
  NumberedStream stream;
  for (int round = 0; round < 2; ++round) {
    for (std::uint64_t i = 0; i < 2000; ++i) stream.arrived(i, stampOf(i));
  }
  EXPECT_EQ(stream.loss().began_again, 1U);
  EXPECT_EQ(stream.loss().lost() + stream.loss().late + stream.loss().repeated, 0U);
}

TEST(NumberedStream, LargestGapAndOneMore) {
  EXPECT_EQ(numbered({5, 5 + NumberedStream::kMaxGap}).missing, NumberedStream::kMaxGap - 1);
  EXPECT_EQ(numbered({5, 6 + NumberedStream::kMaxGap}).missing, 0U);
  EXPECT_EQ(numbered({0, ~std::uint64_t{0}}).began_again, 1U);
}

/// Numbers from 0 on, some of which are lost, late by up to eight or repeated.
std::vector<std::uint64_t> arrivalsOf(unsigned seed) {
  std::mt19937 random(seed);
  std::bernoulli_distribution rarely(0.2);
  std::uniform_int_distribution<std::uint64_t> delay(0, 8);
  std::vector<std::pair<std::uint64_t, std::uint64_t>> arrivals{{0, 0}};  // when, which
  for (std::uint64_t i = 1; i < 300; ++i) {
    if (rarely(random)) continue;
    arrivals.emplace_back(i + delay(random), i);
    if (rarely(random)) arrivals.emplace_back(i + 8 + delay(random), i);
  }
  std::stable_sort(arrivals.begin(), arrivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::uint64_t> order;
  for (const auto& [when, which] : arrivals) order.push_back(which);
  return order;
}

/// Missing are, of the numbers between the first and the last, those that never came.
TEST(NumberedStream, AgreesWithASetOfAllThatCame) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const std::vector<std::uint64_t> order = arrivalsOf(seed);
    const std::set<std::uint64_t> came(order.begin(), order.end());
    const StreamLoss loss = numbered(order);
    EXPECT_EQ(loss.missing, *came.rbegin() + 1 - came.size()) << "seed " << seed;
    EXPECT_EQ(loss.repeated, order.size() - came.size()) << "seed " << seed;
    EXPECT_EQ(loss.began_again, 0U) << "seed " << seed;
  }
}

TEST(StampedStream, LosesNothingOfNoneOneOrAll) {
  EXPECT_EQ(stamped({}).lost(), 0U);
  EXPECT_EQ(stamped({7}).lost(), 0U);
  EXPECT_EQ(stamped(upTo(500)).lost(), 0U);
}

TEST(StampedStream, SuspectsAsManyAsFitIntoAGap) {
  auto numbers = upTo(50);
  numbers.insert(numbers.end(), {51, 52, 60, 61});
  EXPECT_EQ(stamped(numbers).suspected, 1U + 7U);
}

TEST(StampedStream, JitterIsNoGap) {
  StampedStream stream;
  std::mt19937 random(1);
  std::uniform_int_distribution<int> jitter_ms(-2, 2);
  for (std::uint64_t i = 0; i < 1000; ++i) stream.arrived(stampOf(i) + std::chrono::milliseconds(jitter_ms(random)));
  EXPECT_EQ(stream.loss().suspected, 0U);
}

TEST(StampedStream, AnotherRateIsSoonTheUsualOne) {
  auto numbers = upTo(50);
  for (std::uint64_t i = 50; i < 1000; i += 5) numbers.push_back(i);
  const StreamLoss loss = stamped(numbers);
  EXPECT_GT(loss.suspected, 0U);
  EXPECT_LE(loss.suspected, 4U * StampedStream::kKnownIntervals);
}

TEST(StampedStream, WhatComesLateOrAgainIsNoGap) {
  auto numbers = upTo(50);
  numbers.insert(numbers.end(), {51, 50, 52, 52, 53});
  const StreamLoss loss = stamped(numbers);
  EXPECT_EQ(loss.suspected, 0U);
  EXPECT_EQ(loss.late, 1U);
  EXPECT_EQ(loss.repeated, 1U);
}

TEST(StampedStream, PublisherThatPausesOrStartsAnewHasLostNothing) {
  StampedStream stream;
  for (std::uint64_t i = 0; i < 50; ++i) stream.arrived(stampOf(i));
  for (std::uint64_t i = 0; i < 50; ++i) stream.arrived(stampOf(i) + kMaxPause + 1s);
  EXPECT_EQ(stream.loss().began_again, 1U);
  for (std::uint64_t i = 0; i < 50; ++i) stream.arrived(stampOf(i));
  EXPECT_EQ(stream.loss().began_again, 2U) << "its clock began anew";
  EXPECT_EQ(stream.loss().lost(), 0U);
}

}  // namespace
}  // namespace nanomap
