#include "firmware_app/safety/pilot_voice.h"

#include <gtest/gtest.h>

#include "tests/unit/firmware_app/safety/healthy.h"

namespace nanomap {
namespace {

SafetyVerdict verdict(State state, std::initializer_list<Fault> faults = {}, bool critical = false) {
  SafetyVerdict made;
  made.state = state;
  for (Fault fault : faults) made.faults.add(fault);
  made.critical = critical;
  return made;
}

TEST(PilotVoice, SaysWhatIsMissingAndThenOnlyFromTimeToTime) {
  PilotVoice voice;
  const SafetyVerdict waiting = verdict(State::kWaiting, {Fault::kDepth, Fault::kAlignment});
  const auto first = voice.step(atMs(0), waiting, Reason::kNoView);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->text, "NanoMap waits for: depth images, alignment");
  EXPECT_EQ(first->severity, Severity::kWarning);
  int said = 0;
  for (int ms = 20; ms <= 10'000; ms += 20) said += voice.step(atMs(ms), waiting, Reason::kNoView).has_value();
  EXPECT_EQ(said, 1);
}

TEST(PilotVoice, FlickeringFaultsAreNotRecited) {
  PilotVoice voice;
  int said = 0;
  for (int ms = 0; ms < 2'000; ms += 20) {
    said +=
        voice.step(atMs(ms), verdict(State::kWaiting, {ms % 40 == 0 ? Fault::kDepth : Fault::kPose}), Reason::kNoView)
            .has_value();
  }
  EXPECT_EQ(said, 1);
}

TEST(PilotVoice, EveryChangeOfStateIsSaidOnce) {
  PilotVoice voice;
  EXPECT_EQ(voice.step(atMs(0), verdict(State::kReady), Reason::kNoGoal)->text,
            "NanoMap ready: switch to OFFBOARD or GUIDED");
  EXPECT_FALSE(voice.step(atMs(20), verdict(State::kReady), Reason::kNoGoal));
  EXPECT_EQ(voice.step(atMs(40), verdict(State::kFlying), Reason::kFlying)->text, "NanoMap flies");
  EXPECT_EQ(voice.step(atMs(60), verdict(State::kBraking, {Fault::kPlan}), Reason::kFlying)->text,
            "NanoMap brakes, without: a plan");
  EXPECT_FALSE(voice.step(atMs(80), verdict(State::kBraking, {Fault::kPlan}), Reason::kFlying));
  const auto critical = voice.step(atMs(600), verdict(State::kBraking, {Fault::kPlan}, true), Reason::kFlying);
  ASSERT_TRUE(critical);
  EXPECT_EQ(critical->severity, Severity::kCritical);
  const auto lost = voice.step(atMs(3000), verdict(State::kLost, {Fault::kPlan}, true), Reason::kFlying);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->severity, Severity::kCritical);
}

TEST(PilotVoice, SwitchThatIsNoOrderIsToBeMadeAgain) {
  PilotVoice voice;
  SafetyVerdict ready = verdict(State::kReady);
  ready.old_switch = true;
  EXPECT_EQ(voice.step(atMs(0), ready, Reason::kNoGoal)->text,
            "NanoMap ready: leave OFFBOARD or GUIDED, and switch again");
  EXPECT_FALSE(voice.step(atMs(20), ready, Reason::kNoGoal));
  ready.old_switch = false;
  EXPECT_EQ(voice.step(atMs(40), ready, Reason::kNoGoal)->text, "NanoMap ready: switch to OFFBOARD or GUIDED");
}

TEST(PilotVoice, SettlingIsNotSaid) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kBraking, {Fault::kPlan}), Reason::kFlying));
  EXPECT_FALSE(voice.step(atMs(20), verdict(State::kBraking), Reason::kFlying));
}

TEST(PilotVoice, LettingGoIsSaidAtAMomentWithoutAFaultToo) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kBraking, {Fault::kDepth}), Reason::kFlying));
  const auto lost = voice.step(atMs(2000), verdict(State::kLost), Reason::kFlying);
  ASSERT_TRUE(lost);
  EXPECT_EQ(lost->text, "NanoMap has let go: take over");
  EXPECT_EQ(lost->severity, Severity::kCritical);
}

TEST(PilotVoice, WhyItHoversIsSaidOnceItHasLasted) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kFlying), Reason::kFlying));
  EXPECT_FALSE(voice.step(atMs(20), verdict(State::kFlying), Reason::kBlocked));
  const auto why = voice.step(atMs(1020), verdict(State::kFlying), Reason::kBlocked);
  ASSERT_TRUE(why);
  EXPECT_EQ(why->text, "NanoMap: " + std::string(toString(Reason::kBlocked)));
  EXPECT_FALSE(voice.step(atMs(3000), verdict(State::kFlying), Reason::kBlocked));
}

TEST(PilotVoice, SmallHopsAtTheGoalAreNoEndOfIt) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kFlying), Reason::kFlying));
  int said = 0;
  for (int ms = 2000; ms < 12'000; ms += 20) {
    const Reason reason = ms % 1000 < 600 ? Reason::kFlying : Reason::kAtGoal;
    said += voice.step(atMs(ms), verdict(State::kFlying), reason).has_value();
  }
  EXPECT_EQ(said, 1);
}

TEST(PilotVoice, ReasonThatComesForMomentsNowAndThenIsNoNews) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kFlying), Reason::kFlying));
  for (int ms = 2000; ms < 12'000; ms += 20) {
    const Reason reason = ms % 2000 < 1200 ? Reason::kFlying : Reason::kBlocked;
    EXPECT_FALSE(voice.step(atMs(ms), verdict(State::kFlying), reason)) << ms;
  }
}

TEST(PilotVoice, ReasonOnTheGroundIsNoNews) {
  PilotVoice voice;
  EXPECT_TRUE(voice.step(atMs(0), verdict(State::kReady), Reason::kNoGoal));
  for (int ms = 20; ms < 5000; ms += 20) EXPECT_FALSE(voice.step(atMs(ms), verdict(State::kReady), Reason::kNoGoal));
}

}  // namespace
}  // namespace nanomap
