#include "core/pose_buffer.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numbers>

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using LookupStatus = PoseBuffer::LookupStatus;
using Verdict = PoseVerdict;

constexpr Time at(std::int64_t ms) { return Time(milliseconds(ms)); }

BodyPose poseAt(std::int64_t ms, double x_m, std::uint32_t epoch = 0) {
  BodyPose pose;
  pose.stamp = at(ms);
  pose.T_W_B.translation_m = {x_m, 0.0, 0.0};
  pose.epoch = epoch;
  return pose;
}

PoseBuffer buffer() { return PoseBuffer(8, milliseconds(500)); }

TEST(PoseBuffer, EmptyFindsNothing) { EXPECT_EQ(buffer().interpolate(at(0)).status, LookupStatus::kAfterNewest); }

TEST(PoseBuffer, OnePoseIsFoundAtItsStampOnly) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(10, 1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.interpolate(at(9)).status, LookupStatus::kBeforeOldest);
  EXPECT_EQ(poses.interpolate(at(10)).status, LookupStatus::kFound);
  EXPECT_EQ(poses.interpolate(at(11)).status, LookupStatus::kAfterNewest);
}

TEST(PoseBuffer, InterpolatesAcrossASecondBoundary) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(900, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(1100, 2.0)), Verdict::kAccepted);
  EXPECT_DOUBLE_EQ(poses.interpolate(at(1000)).T_W_B.translation_m.x(), 1.0);
}

TEST(PoseBuffer, SlerpsTheShortWayRound) {
  PoseBuffer poses = buffer();
  BodyPose from = poseAt(0, 0.0);
  BodyPose to = poseAt(100, 0.0);
  const Eigen::AngleAxisd quarter_turn(std::numbers::pi / 2.0, Vec3::UnitZ());
  to.T_W_B.rotation = quarter_turn;
  to.T_W_B.rotation.coeffs() *= -1.0;  // the same rotation, on the other half of the sphere
  EXPECT_EQ(poses.insert(from), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(to), Verdict::kAccepted);
  const Quat expected(Eigen::AngleAxisd(std::numbers::pi / 4.0, Vec3::UnitZ()));
  EXPECT_LT(poses.interpolate(at(50)).T_W_B.rotation.angularDistance(expected), 1e-12);
}

TEST(PoseBuffer, AWalkFindsWhatEveryLookupFinds) {
  PoseBuffer poses = buffer();
  PoseBuffer::Walk over_nothing(poses);
  EXPECT_EQ(over_nothing.to(at(0)).status, LookupStatus::kAfterNewest);
  for (const int ms : {100, 200, 1100, 1200}) {
    EXPECT_EQ(poses.insert(poseAt(ms, ms, ms < 1200 ? 0 : 1)), Verdict::kAccepted);
  }
  PoseBuffer::Walk walk(poses);
  for (int ms = 0; ms <= 1300; ms += 25) {
    const PoseBuffer::Lookup expected = poses.interpolate(at(ms));
    for (int repeat = 0; repeat < 2; ++repeat) {
      const PoseBuffer::Bracket got = walk.to(at(ms));
      ASSERT_EQ(got.status, expected.status) << ms;
      if (got.status != LookupStatus::kFound) continue;
      EXPECT_EQ(got.T_W_B(), expected.T_W_B) << ms;
      EXPECT_EQ(got.to->epoch, expected.epoch) << ms;
    }
  }
}

TEST(PoseBuffer, JudgesRepeatedStamps) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(10, 1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(10, 1.0)), Verdict::kDuplicate);
  EXPECT_EQ(poses.insert(poseAt(10, 2.0)), Verdict::kConflict);
  EXPECT_EQ(poses.size(), 1U);
  EXPECT_EQ(poses.newest().T_W_B.translation_m.x(), 1.0);
}

TEST(PoseBuffer, RefusesWhatIsNotAPose) {
  PoseBuffer poses = buffer();
  BodyPose pose = poseAt(0, std::numeric_limits<double>::quiet_NaN());
  EXPECT_EQ(poses.insert(pose), Verdict::kNotFinite);
  pose = poseAt(0, 0.0);
  pose.T_W_B.rotation.w() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(poses.insert(pose), Verdict::kNotFinite);
  pose.T_W_B.rotation = Quat(1.01, 0.0, 0.0, 0.0);
  EXPECT_EQ(poses.insert(pose), Verdict::kNotUnit);
  pose.T_W_B.rotation = Quat(0.0, 0.0, 0.0, 0.0);
  EXPECT_EQ(poses.insert(pose), Verdict::kNotUnit);
  EXPECT_TRUE(poses.empty());
}

TEST(PoseBuffer, ASinglePrecisionQuaternionIsNormalised) {
  PoseBuffer poses = buffer();
  BodyPose pose = poseAt(0, 0.0);
  pose.T_W_B.rotation = Quat(1.0 + 1e-7, 0.0, 0.0, 0.0);
  EXPECT_EQ(poses.insert(pose), Verdict::kAccepted);
  EXPECT_DOUBLE_EQ(poses.newest().T_W_B.rotation.norm(), 1.0);
}

TEST(PoseBuffer, NeverInterpolatesBetweenEpochs) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(0, 0.0, 1)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(10, 100.0, 2)), Verdict::kAccepted);
  EXPECT_EQ(poses.interpolate(at(5)).status, LookupStatus::kBetweenEpochs);
  EXPECT_EQ(poses.interpolate(at(0)).epoch, 1U);
  EXPECT_EQ(poses.interpolate(at(10)).epoch, 2U);
}

TEST(PoseBuffer, RefusesAnEpochThatContradictsItsNeighbours) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(0, 0.0, 1)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(20, 0.0, 2)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(30, 0.0, 1)), Verdict::kStaleEpoch);
  EXPECT_EQ(poses.insert(poseAt(-10, 0.0, 2)), Verdict::kStaleEpoch);
  EXPECT_EQ(poses.insert(poseAt(10, 0.0, 1)), Verdict::kAccepted) << "late, but of its own world";
}

TEST(PoseBuffer, DoesNotInterpolateAcrossAGap) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(poseAt(0, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(501, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.interpolate(at(250)).status, LookupStatus::kGap);
  EXPECT_EQ(poses.insert(poseAt(300, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.interpolate(at(250)).status, LookupStatus::kFound) << "a late pose closes the gap";
}

TEST(PoseBuffer, IsBoundedAndForgetsTheOldest) {
  PoseBuffer poses = buffer();
  for (int i = 0; i < 20; ++i) EXPECT_EQ(poses.insert(poseAt(i * 10, i)), Verdict::kAccepted);
  EXPECT_EQ(poses.size(), 8U);
  EXPECT_EQ(poses.oldest().stamp, at(120));
  EXPECT_EQ(poses.insert(poseAt(50, 0.0)), Verdict::kTooOld);
  EXPECT_EQ(poses.insert(poseAt(135, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.size(), 8U);
  EXPECT_EQ(poses.oldest().stamp, at(130));
}

/// Whatever the order of arrival, the buffer holds the newest distinct stamps in order.
RC_GTEST_PROP(PoseBuffer, AnyArrivalOrderGivesTheSameBuffer, ()) {
  const auto stamps_ms = *rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 40));
  PoseBuffer poses(64, milliseconds(500));
  std::map<int, int> oracle;
  for (const int ms : stamps_ms) {
    const bool fresh = oracle.emplace(ms, ms).second;
    RC_ASSERT(poses.insert(poseAt(ms, ms)) == (fresh ? Verdict::kAccepted : Verdict::kDuplicate));
  }
  RC_ASSERT(poses.size() == oracle.size());
  if (oracle.empty()) return;
  for (int ms = oracle.begin()->first; ms <= oracle.rbegin()->first; ++ms) {
    const auto found = poses.interpolate(at(ms));
    RC_ASSERT(found.status == LookupStatus::kFound);
    RC_ASSERT(std::abs(found.T_W_B.translation_m.x() - ms) < 1e-9);
  }
}

BodyPose withIncrement(std::int64_t ms, std::int64_t interval_ms, double variance_m2) {
  BodyPose pose = poseAt(ms, 0.0);
  pose.increment = DriftIncrement{variance_m2 * Mat3::Identity(), milliseconds(interval_ms)};
  return pose;
}

TEST(PoseBuffer, AccumulatesIncrementsInProportion) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(withIncrement(0, 10, 1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(withIncrement(10, 10, 2.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(withIncrement(20, 10, 4.0)), Verdict::kAccepted);
  EXPECT_DOUBLE_EQ((*poses.accumulatedCovariance(at(0), at(20)))(0, 0), 6.0);
  EXPECT_DOUBLE_EQ((*poses.accumulatedCovariance(at(5), at(15)))(1, 1), 3.0);
  EXPECT_DOUBLE_EQ((*poses.accumulatedCovariance(at(12), at(14)))(2, 2), 0.8);
  EXPECT_DOUBLE_EQ((*poses.accumulatedCovariance(at(10), at(10)))(2, 2), 0.0);
}

TEST(PoseBuffer, ALostIncrementIsTakenAtTheNextOnesRate) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(withIncrement(0, 10, 1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(withIncrement(20, 10, 2.0)), Verdict::kAccepted);
  EXPECT_DOUBLE_EQ((*poses.accumulatedCovariance(at(0), at(20)))(0, 0), 4.0);
}

TEST(PoseBuffer, AMissingOrImpossibleIncrementIsUnknownNotZero) {
  PoseBuffer poses = buffer();
  EXPECT_EQ(poses.insert(withIncrement(0, 10, 1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(poseAt(10, 0.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(withIncrement(20, 10, -1.0)), Verdict::kAccepted);
  EXPECT_EQ(poses.insert(withIncrement(30, 0, 1.0)), Verdict::kAccepted);
  EXPECT_FALSE(poses.accumulatedCovariance(at(0), at(10)));
  EXPECT_FALSE(poses.accumulatedCovariance(at(10), at(20)));
  EXPECT_FALSE(poses.accumulatedCovariance(at(20), at(30)));
  EXPECT_FALSE(poses.accumulatedCovariance(at(30), at(40))) << "no pose that far";
}

}  // namespace
}  // namespace nanomap
