#include "drivers/recording/log_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <sstream>

#include "tests/unit/drivers/recording/log_bytes.h"

namespace nanomap {

/// In failure messages, and for the matchers below.
bool operator==(const LogDamage& a, const LogDamage& b) {
  return a.cause == b.cause && a.offset_bytes == b.offset_bytes && a.size_bytes == b.size_bytes;
}
void PrintTo(const LogDamage& damage, std::ostream* out) {
  *out << toString(damage.cause) << " at " << damage.offset_bytes << ", " << damage.size_bytes << " bytes";
}

namespace {

using Cause = LogDamage::Cause;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::size_t kWindow = 4096;

LogIndex indexOf(const std::string& bytes, std::size_t window_bytes = kWindow) {
  std::istringstream log(bytes);
  return indexLog(log, window_bytes);
}

std::vector<std::uint64_t> offsetsOf(const LogIndex& index) {
  std::vector<std::uint64_t> offsets;
  for (const LogEvent& event : index.events) offsets.push_back(event.offset_bytes);
  return offsets;
}

const std::string kFirst = event(10, "POSE", "first message");
const std::string kSecond = event(20, "DEPTH", "the second message");
const std::string kThird = event(30, "POSE", "");

TEST(LogIndex, EmptyLogHasNothing) {
  const LogIndex index = indexOf("");
  EXPECT_THAT(index.events, IsEmpty());
  EXPECT_THAT(index.damage, IsEmpty());
  EXPECT_EQ(index.size_bytes, 0U);
}

TEST(LogIndex, WholeEventsAreFoundWithTheirFields) {
  const LogIndex index = indexOf(kFirst + kSecond + kThird);
  ASSERT_EQ(index.events.size(), 3U);
  EXPECT_THAT(index.damage, IsEmpty());
  EXPECT_THAT(index.channels, ElementsAre("POSE", "DEPTH"));
  EXPECT_EQ(index.events[1].offset_bytes, kFirst.size());
  EXPECT_EQ(index.events[1].log_stamp, Time(std::chrono::microseconds(20)));
  EXPECT_EQ(index.events[1].channel, 1U);
  EXPECT_EQ(index.events[1].data_bytes, 18U);
  EXPECT_EQ(index.events[2].channel, 0U);
  EXPECT_EQ(index.events[2].data_bytes, 0U);
}

TEST(LogIndex, GarbageAroundEventsIsSkippedAndNamed) {
  const std::string garbage = "garbage";
  const LogIndex index = indexOf(garbage + kFirst + garbage + kSecond + garbage);
  EXPECT_THAT(offsetsOf(index), ElementsAre(7U, 14U + kFirst.size()));
  EXPECT_THAT(index.damage,
              ElementsAre(LogDamage{Cause::kGarbage, 0, 7}, LogDamage{Cause::kGarbage, 7 + kFirst.size(), 7},
                          LogDamage{Cause::kGarbage, 14 + kFirst.size() + kSecond.size(), 7}));
}

TEST(LogIndex, LogCutAnywhereKeepsTheEventsBefore) {
  const std::string whole = kFirst + kSecond;
  for (std::size_t size = kFirst.size() + 4; size < whole.size(); ++size) {
    const LogIndex index = indexOf(whole.substr(0, size));
    EXPECT_THAT(offsetsOf(index), ElementsAre(0U)) << size;
    EXPECT_THAT(index.damage, ElementsAre(LogDamage{Cause::kCutOff, kFirst.size(), size - kFirst.size()})) << size;
  }
}

TEST(LogIndex, LengthThatReachesIntoTheNextEventLosesOnlyItsOwn) {
  for (const std::int32_t lie : {5, 40, 45, 46, 60, 1'000'000, 2'147'483'647}) {
    const std::string damaged = EventBytes{.utime_us = 15, .data = "abcd", .data_length = lie}.str();
    const LogIndex index = indexOf(kFirst + damaged + kSecond + kThird);
    EXPECT_THAT(offsetsOf(index),
                ElementsAre(0U, kFirst.size() + damaged.size(), kFirst.size() + damaged.size() + kSecond.size()))
        << lie;
    EXPECT_THAT(index.damage, ElementsAre(LogDamage{Cause::kOverrun, kFirst.size(), damaged.size()})) << lie;
  }
}

TEST(LogIndex, CauseIsThatOfTheFirstDamagedByte) {
  const std::string overrun = EventBytes{.data_length = 1000}.str();
  const LogIndex garbage_first = indexOf("garbage" + overrun + kFirst);
  EXPECT_THAT(garbage_first.damage, ElementsAre(LogDamage{Cause::kGarbage, 0, 7 + overrun.size()}));
  const LogIndex overrun_first = indexOf(overrun + "garbage" + kFirst);
  EXPECT_THAT(overrun_first.damage, ElementsAre(LogDamage{Cause::kOverrun, 0, overrun.size() + 7}));
}

TEST(LogIndex, LengthThatSwallowsTheNextEventExactlyLosesOnlyItsOwn) {
  const auto lie = static_cast<std::int32_t>(4 + kSecond.size());
  const std::string damaged = EventBytes{.data = "abcd", .data_length = lie}.str();
  EXPECT_THAT(offsetsOf(indexOf(damaged + kSecond + kThird)),
              ElementsAre(damaged.size(), damaged.size() + kSecond.size()));
}

TEST(LogIndex, ImplausibleHeadersAreGarbage) {
  const std::vector<EventBytes> implausible = {
      {.data_length = -1},
      {.channel_length = -1},
      {.channel_length = 0},
      {.channel_length = 64},
      {.channel_length = 2'147'483'647},
      {.channel = "BELL\a"},
      {.utime_us = -1},
      {.utime_us = (std::int64_t{1} << 62) / 1000 + 1},
  };
  for (const EventBytes& header : implausible) {
    const std::string bytes = header.str();
    const LogIndex index = indexOf(kFirst + bytes + kSecond);
    EXPECT_THAT(offsetsOf(index), ElementsAre(0U, kFirst.size() + bytes.size()));
    EXPECT_THAT(index.damage, ElementsAre(LogDamage{Cause::kGarbage, kFirst.size(), bytes.size()}));
  }
}

TEST(LogIndex, SyncWordInAMessageIsNoEvent) {
  const std::string sync(kLogSync);
  const std::string message = event(5, "POSE", sync + "x" + sync + sync + std::string(100, '\xFF') + sync);
  const LogIndex index = indexOf(message + kFirst);
  EXPECT_THAT(offsetsOf(index), ElementsAre(0U, message.size()));
  EXPECT_THAT(index.damage, IsEmpty());
  EXPECT_THAT(indexOf(message).damage, IsEmpty()) << "as the last event";
}

TEST(LogIndex, RepeatedSyncWordIsSkipped) {
  const LogIndex index = indexOf(std::string(kLogSync) + kFirst);
  EXPECT_THAT(offsetsOf(index), ElementsAre(4U));
}

TEST(LogIndex, LongestChannelNameIsRead) {
  const std::string name(kMaxChannelBytes, 'x');
  EXPECT_THAT(indexOf(event(1, name, "data")).channels, ElementsAre(name));
}

TEST(LogIndex, HeaderAcrossWindowsIsFoundAtAnyOffset) {
  const std::string longest = event(1, std::string(kMaxChannelBytes, 'x'), "data");
  for (std::size_t offset = 0; offset < 3 * kMinLogWindowBytes; ++offset) {
    const LogIndex index = indexOf(std::string(offset, 'g') + longest + kFirst, kMinLogWindowBytes);
    EXPECT_THAT(offsetsOf(index), ElementsAre(offset, offset + longest.size()));
  }
}

TEST(LogIndex, StampsMayGoBackwards) {
  const LogIndex index = indexOf(event(30, "A", "") + event(10, "A", "") + event(10, "A", ""));
  EXPECT_EQ(index.events.size(), 3U);
  EXPECT_THAT(index.damage, IsEmpty());
}

TEST(LogDamage, EveryCauseHasItsWords) {
  std::set<std::string_view> words;
  for (const Cause cause : {Cause::kGarbage, Cause::kOverrun, Cause::kCutOff}) words.insert(toString(cause));
  EXPECT_EQ(words.size(), 3U);
  EXPECT_FALSE(words.contains("?"));
}

/// A few events of any content, in the shape of a flight's log.
rc::Gen<std::vector<std::string>> anyEvents() {
  return rc::gen::container<std::vector<std::string>>(rc::gen::map(
      rc::gen::tuple(rc::gen::inRange<std::int64_t>(0, 1'000'000),
                     rc::gen::element<std::string>("POSE_BODY", "D", "a channel with a long name"),
                     rc::gen::arbitrary<std::string>()),
      [](const auto& fields) { return event(std::get<0>(fields), std::get<1>(fields), std::get<2>(fields)); }));
}

/// Events and damage, in turn, are the whole log and do not overlap.
void assertCovered(const LogIndex& index, const std::string& log) {
  std::uint64_t at = 0;
  auto damage = index.damage.begin();
  const auto skipDamage = [&] {
    if (damage != index.damage.end() && damage->offset_bytes == at) {
      RC_ASSERT(damage->size_bytes > 0U);
      at += (damage++)->size_bytes;
    }
  };
  for (const LogEvent& found : index.events) {
    skipDamage();
    RC_ASSERT(found.offset_bytes == at);
    at += kLogHeaderBytes + index.channels.at(found.channel).size() + found.data_bytes;
  }
  skipDamage();
  RC_ASSERT(at == log.size());
  RC_ASSERT(index.size_bytes == log.size());
  RC_ASSERT(damage == index.damage.end());
}

RC_GTEST_PROP(LogIndex, WindowSizeDoesNotMatter, ()) {
  std::string log;
  for (const std::string& bytes : *anyEvents()) log += bytes;
  const auto damaged_at = *rc::gen::inRange<std::size_t>(0, log.size() + 1);
  log.insert(damaged_at, *rc::gen::arbitrary<std::string>());
  const LogIndex whole = indexOf(log, 1U << 20U);
  const LogIndex windowed = indexOf(log, *rc::gen::inRange<std::size_t>(kMinLogWindowBytes, 200));
  RC_ASSERT(offsetsOf(windowed) == offsetsOf(whole));
  RC_ASSERT(windowed.damage == whole.damage);
  assertCovered(whole, log);
}

RC_GTEST_PROP(LogIndex, EveryUndamagedEventIsFound, ()) {
  const std::vector<std::string> events = *anyEvents();
  std::string log;
  std::vector<std::uint64_t> starts;
  for (const std::string& bytes : events) {
    starts.push_back(log.size());
    log += bytes;
  }
  std::vector<bool> touched(log.size(), false);
  const auto bursts = log.empty() ? 0 : *rc::gen::inRange(0, 4);
  for (int i = 0; i < bursts; ++i) {
    const auto at = *rc::gen::inRange<std::size_t>(0, log.size());
    const std::string burst = *rc::gen::nonEmpty<std::string>();
    for (std::size_t j = 0; j < burst.size() && at + j < log.size(); ++j) {
      log[at + j] = burst[j];
      touched[at + j] = true;
    }
  }

  const LogIndex index = indexOf(log);
  assertCovered(index, log);
  const std::vector<std::uint64_t> found = offsetsOf(index);
  for (std::size_t i = 0; i < events.size(); ++i) {
    const auto first = touched.begin() + static_cast<std::ptrdiff_t>(starts[i]);
    if (std::find(first, first + static_cast<std::ptrdiff_t>(events[i].size()), true) !=
        first + static_cast<std::ptrdiff_t>(events[i].size())) {
      continue;
    }
    const auto at = std::find(found.begin(), found.end(), starts[i]);
    RC_ASSERT(at != found.end());
    const LogEvent& event_found = index.events[static_cast<std::size_t>(at - found.begin())];
    RC_ASSERT(kLogHeaderBytes + index.channels.at(event_found.channel).size() + event_found.data_bytes ==
              events[i].size());
  }
}

RC_GTEST_PROP(LogIndex, BitFlipsInHeadersLoseOnlyTheirEvents, ()) {
  // Equal events whose size is a power of two: one flipped bit of a length swallows whole neighbours exactly.
  const std::string one = event(7, "POSE", std::string(32, 'm'));
  RC_ASSERT(one.size() == 64U);
  constexpr std::size_t kEvents = 8;
  std::string log;
  for (std::size_t i = 0; i < kEvents; ++i) log += one;
  const auto hit = *rc::gen::inRange<std::size_t>(0, kEvents);
  const auto bit = *rc::gen::inRange<unsigned>(0, 32);
  char& byte = log[hit * one.size() + 24 + bit / 8];  // the data length
  byte = static_cast<char>(static_cast<unsigned char>(byte) ^ (1U << (bit % 8)));
  const std::vector<std::uint64_t> found = offsetsOf(indexOf(log));
  for (std::size_t i = 0; i < kEvents; ++i) {
    if (i != hit) RC_ASSERT(std::count(found.begin(), found.end(), i * one.size()) == 1);
  }
}

}  // namespace
}  // namespace nanomap
