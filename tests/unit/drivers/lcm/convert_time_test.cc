#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <limits>
#include <set>

#include "drivers/lcm/convert.h"

namespace nanomap {
namespace {

constexpr std::int64_t kLatestUtime_us = (std::int64_t{1} << 62) / 1000;

TEST(TimeFromUtime, MicrosecondsBecomeNanoseconds) {
  EXPECT_EQ(std::get<Time>(timeFromUtime(0)), timeFromNanoseconds(0));
  EXPECT_EQ(std::get<Time>(timeFromUtime(1'999'999)), timeFromNanoseconds(1'999'999'000));
  EXPECT_EQ(std::get<Time>(timeFromUtime(2'000'000)), timeFromNanoseconds(2'000'000'000));
}

TEST(TimeFromUtime, RangeEndsAreExact) {
  EXPECT_TRUE(std::holds_alternative<Time>(timeFromUtime(kLatestUtime_us)));
  for (const std::int64_t bad : {std::int64_t{-1}, kLatestUtime_us + 1, std::numeric_limits<std::int64_t>::max(),
                                 std::numeric_limits<std::int64_t>::min()}) {
    EXPECT_EQ(std::get<ConvertFault>(timeFromUtime(bad)), ConvertFault::kBadStamp) << bad;
  }
}

TEST(UtimeFromTime, IsCutNotRounded) {
  EXPECT_EQ(utimeFromTime(timeFromNanoseconds(999)), 0);
  EXPECT_EQ(utimeFromTime(timeFromNanoseconds(1'000)), 1);
  EXPECT_EQ(utimeFromTime(timeFromNanoseconds(1'999'999'999)), 1'999'999);
}

RC_GTEST_PROP(UtimeFromTime, UndoesTimeFromUtime, ()) {
  const auto utime_us = *rc::gen::inRange<std::int64_t>(0, kLatestUtime_us + 1);
  RC_ASSERT(utimeFromTime(std::get<Time>(timeFromUtime(utime_us))) == utime_us);
}

TEST(ConvertFault, EveryOneHasItsWords) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i < kConvertFaultCount; ++i) words.insert(toString(static_cast<ConvertFault>(i)));
  EXPECT_EQ(words.size(), kConvertFaultCount);
  EXPECT_FALSE(words.contains("?"));
}

}  // namespace
}  // namespace nanomap
