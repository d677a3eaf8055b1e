#include "firmware_app/pipeline/step.h"

#include <gtest/gtest.h>

#include <limits>

namespace nanomap {
namespace {

step_t message() {
  return toMessage(Step{.taken = Time(std::chrono::milliseconds(1500)),
                        .number = 7,
                        .kind = InputKind::kGoal,
                        .arrival = Time(std::chrono::seconds(1)),
                        .stamp_shift = Duration(-12345)});
}

TEST(Step, MessageSaysWhatWasTakenInAndWhen) {
  EXPECT_EQ(message().utime, 1'500'000);
  EXPECT_EQ(message().number, 7);
  EXPECT_EQ(message().kind, step_t::GOAL);
  EXPECT_EQ(message().arrival_utime, 1'000'000);
  EXPECT_EQ(message().stamp_shift, -12345);
}

TEST(Step, ComesBackFromItsMessage) {
  const auto step = toStep(message());
  ASSERT_TRUE(step);
  EXPECT_EQ(step->taken, Time(std::chrono::milliseconds(1500)));
  EXPECT_EQ(step->number, 7U);
  EXPECT_EQ(step->kind, InputKind::kGoal);
  EXPECT_EQ(step->arrival, Time(std::chrono::seconds(1)));
  EXPECT_EQ(step->stamp_shift, Duration(-12345));
}

TEST(Step, MessageThatCannotBeIsNone) {
  const auto refused = [](auto change) {
    step_t changed = message();
    change(changed);
    return !toStep(changed);
  };
  EXPECT_TRUE(refused([](step_t& m) { m.utime = -1; }));
  EXPECT_TRUE(refused([](step_t& m) { m.arrival_utime = std::numeric_limits<std::int64_t>::max(); }));
  EXPECT_TRUE(refused([](step_t& m) { m.number = 0; }));
  EXPECT_TRUE(refused([](step_t& m) { m.number = -1; }));
  EXPECT_TRUE(refused([](step_t& m) { m.kind = -1; }));
  EXPECT_TRUE(refused([](step_t& m) { m.kind = static_cast<std::int8_t>(kInputKindCount); }));
}

}  // namespace
}  // namespace nanomap
