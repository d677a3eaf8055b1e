#include "tools/sim/live_flyer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "tools/generate/paper_camera.h"

namespace nanomap::sim {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart = Time(1'999'800ms);
constexpr double kRadius_m = 0.4;

/// Flies north at 5 m/s, 2 m above the ground, past what is there, until it stands; told at 50 Hz as time goes on.
class Autopilot : public AutopilotLink {
 public:
  Autopilot(const Time& now, double way_m) : now_(now), way_m_(way_m) {}

  void keepAlive(SystemStatus /*status*/) override { ++signs_of_life; }
  SendResult send(const LocalNedTarget& /*target*/) override { return SendResult::kRefused; }
  SendResult send(const ObstacleDistances& /*distances*/) override { return SendResult::kRefused; }
  SendResult send(const OdometryMessage& /*odometry*/) override { return SendResult::kRefused; }
  SendResult sendText(Severity /*severity*/, std::string_view /*text*/) override { return SendResult::kRefused; }
  AutopilotState autopilot() const override { return {}; }
  std::optional<AutopilotPose> takePose() override {
    if (next_ > now_ || next_ > silent_from) return std::nullopt;
    AutopilotPose pose;
    pose.stamp = next_;
    const double flown_m = std::min(kSpeed_m_s * toSeconds(next_ - kStart), way_m_);
    pose.position_NED_m = {flown_m, 0.0, -2.0};
    pose.velocity_NED_m_s = {flown_m < way_m_ ? kSpeed_m_s : 0.0, 0.0, 0.0};
    next_ += 20ms;
    return pose;
  }

  static constexpr double kSpeed_m_s = 5.0;
  Time silent_from = Time::max();
  int signs_of_life = 0;

 private:
  const Time& now_;
  double way_m_;
  Time next_ = kStart;
};

/// Time passes while one waits for messages, of which there are none.
class Silence : public MessageSource {
 public:
  explicit Silence(Time& now) : now_(now) {}
  Wait wait(Duration timeout, const Handler& /*handler*/) override {
    now_ += timeout;
    return Wait::kTimeout;
  }

 private:
  Time& now_;
};

class LiveFlyerTest : public testing::Test {
 protected:
  /// A warehouse's aisle is 40 m long; the way is straight ahead.
  LiveFlightSummary fly(double way_m, Duration duration, const SensorFaultPlanParameters& faults = {}) {
    generate::SensedFlightOptions options;
    options.scene = "warehouse";
    options.camera = generate::paperCamera(16, 12);
    options.vio.drift = {.horizontal_std_m = 0.0, .vertical_std_m = 0.0};
    const generate::SensedFlight flight(options);
    Autopilot autopilot(now_, way_m);
    autopilot.silent_from = silent_from_;
    Silence silence(now_);
    LiveSurroundings surroundings{.autopilot = autopilot,
                                  .heard = silence,
                                  .publish =
                                      [&](const std::string& channel, Bytes) {
                                        published_[channel].push_back(now_);
                                        now_ += slow_;
                                        return true;
                                      },
                                  .now = [&] { return now_; },
                                  .stopped = [&] { return now_ >= stop_; }};
    TrueMotion motion{NedFromWorld(0.0, Vec3(3.0, 0.0, 0.0))};
    motion.add(*autopilot.takePose());
    LiveFlyer flyer(Configuration(), flight.scene(), kRadius_m, 33ms, std::move(motion), faults, {}, surroundings);
    (void)flight.fly(LcmParameters(), kStart, duration, flyer);
    signs_of_life_ = autopilot.signs_of_life;
    return flyer.summary();
  }

  Time now_ = kStart;
  Time silent_from_ = Time::max();
  Time stop_ = Time::max();
  Duration slow_{};
  int signs_of_life_ = 0;
  std::map<std::string, std::vector<Time>> published_;  ///< when, by channel
};

TEST_F(LiveFlyerTest, PublishesEachMessageAtItsTime) {
  (void)fly(3.0, 1s);
  ASSERT_EQ(published_["POSE_BODY"].size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) {
    EXPECT_EQ(published_["POSE_BODY"][i], kStart + i * 10ms + 5ms);
  }
  ASSERT_EQ(published_["DEPTH"].size(), 30U);
  EXPECT_EQ(published_["DEPTH"][0], kStart + 30ms);
  EXPECT_EQ(published_["CAMERA"].size(), 1U);
  EXPECT_EQ(published_["GOAL"].size(), 1U);
  EXPECT_GE(signs_of_life_, 10);
}

TEST_F(LiveFlyerTest, FollowsTheAutopilotsVehicle) {
  const LiveFlightSummary summary = fly(3.0, 1s);
  EXPECT_EQ(summary.outcome, Outcome::kUnderWay);
  EXPECT_EQ(summary.top_speed_m_s, Autopilot::kSpeed_m_s);
  ASSERT_TRUE(summary.departure);
  EXPECT_EQ(*summary.departure, kStart + 210ms);
  EXPECT_GT(summary.extrapolation.count, 40U);
}

TEST_F(LiveFlyerTest, EndsInACollision) {
  const LiveFlightSummary summary = fly(1000.0, 60s);
  EXPECT_EQ(summary.outcome, Outcome::kCollision);
  EXPECT_LT(now_ - kStart, 30s);
}

TEST_F(LiveFlyerTest, EndsWhenTheUserWishes) {
  stop_ = kStart + 500ms;
  (void)fly(3.0, 60s);
  EXPECT_LT(now_ - kStart, 600ms);
}

TEST_F(LiveFlyerTest, FaultsBeginWithTheDeparture) {
  (void)fly(3.0, 2s, {.camera = Outage{500ms, 1s}, .estimator = {}, .jump = {}});
  EXPECT_NEAR(static_cast<double>(published_["DEPTH"].size()), 30.0, 2.0);
  EXPECT_EQ(published_["POSE_BODY"].size(), 200U);
}

TEST_F(LiveFlyerTest, ASlowMachineLeavesFramesOut) {
  slow_ = 11ms;  // for every message: more than there is
  const LiveFlightSummary summary = fly(3.0, 2s);
  EXPECT_GT(summary.worst_lateness, 33ms);
  EXPECT_LT(published_["DEPTH"].size(), 30U);
  EXPECT_EQ(published_["POSE_BODY"].size(), 200U);
}

TEST_F(LiveFlyerTest, WithoutTheAutopilotItCannotGoOn) {
  silent_from_ = kStart + 1s;
  EXPECT_THROW((void)fly(3.0, 10s), std::runtime_error);
  EXPECT_LT(now_ - kStart, 2100ms);
}

}  // namespace
}  // namespace nanomap::sim
