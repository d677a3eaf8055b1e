#include "core/correction.h"

#include <gtest/gtest.h>

#include <limits>
#include <numbers>

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using Coverage = CorrectionField::Coverage;

constexpr Time at(std::int64_t ms) { return Time(milliseconds(ms)); }

/// A flight that turns and accelerates, so that interpolating poses and interpolating deltas differ.
Pose originalAt(std::int64_t ms) {
  const double t_s = static_cast<double>(ms) / 1000.0;
  return {Quat(Eigen::AngleAxisd(1.5 * t_s, Vec3::UnitZ())),
          Vec3(3.0 * std::sin(2.0 * t_s), 4.0 * t_s * t_s, 1.0 + t_s)};
}

const Pose kDelta{Quat(Eigen::AngleAxisd(0.2, Vec3::UnitZ())), Vec3(1.0, -2.0, 0.5)};

/// Original poses every 10 ms over 0 .. 2 s; before `jump_ms` of epoch 1, from then on of epoch 2.
PoseBuffer originals(std::int64_t jump_ms) {
  PoseBuffer poses(512, milliseconds(100));
  for (std::int64_t ms = 0; ms <= 2000; ms += 10) {
    const bool jumped = ms >= jump_ms;
    BodyPose pose;
    pose.stamp = at(ms);
    pose.T_W_B = jumped ? kDelta * originalAt(ms) : originalAt(ms);
    pose.epoch = jumped ? 2 : 1;
    EXPECT_EQ(poses.insert(pose), PoseVerdict::kAccepted);
  }
  return poses;
}

constexpr std::int64_t kNever = 1'000'000;

/// The window from_ms .. to_ms, shifted by kDelta, a pose every `step_ms`.
Correction shifted(std::int64_t from_ms, std::int64_t to_ms, std::int64_t step_ms, std::uint32_t epoch) {
  Correction correction;
  correction.epoch = epoch;
  for (std::int64_t ms = from_ms; ms <= to_ms; ms += step_ms) {
    correction.poses.push_back({at(ms), kDelta * originalAt(ms)});
  }
  return correction;
}

/// An original pose, corrected.
struct Corrected {
  Coverage coverage;
  Pose T_W_B;
};
Corrected apply(const CorrectionField& field, Time stamp, const Pose& T_W_B_original, std::uint32_t epoch) {
  const CorrectionField::Delta delta = field.deltaAt(stamp, epoch);
  if (delta.coverage == Coverage::kNone) return {delta.coverage, {}};
  return {delta.coverage, delta.T_Wnew_Wold() * T_W_B_original};
}

void expectSame(const Pose& a, const Pose& b) {
  EXPECT_LT((a.translation_m - b.translation_m).norm(), 1e-9);
  EXPECT_LT(a.rotation.angularDistance(b.rotation), 1e-7);
}

TEST(CorrectionField, ASparseWindowKeepsTheMotionBetweenItsStamps) {
  const CorrectionField field(shifted(500, 1500, 500, 1), originals(kNever));
  for (std::int64_t ms = 500; ms <= 1500; ms += 50) {
    const auto corrected = apply(field, at(ms), originalAt(ms), 1);
    ASSERT_EQ(corrected.coverage, Coverage::kInside) << ms;
    expectSame(corrected.T_W_B, kDelta * originalAt(ms));
  }
}

TEST(CorrectionField, DeltasAreInterpolatedLinearlyInTime) {
  Correction correction;
  correction.poses = {{at(0), originalAt(0)}, {at(1000), originalAt(1000)}};
  correction.poses[1].T_W_B.translation_m.x() += 1.0;
  correction.epoch = 1;
  const CorrectionField field(correction, originals(kNever));
  const auto corrected = apply(field, at(250), originalAt(250), 1);
  EXPECT_NEAR(corrected.T_W_B.translation_m.x(), originalAt(250).translation_m.x() + 0.25, 1e-9);
}

TEST(CorrectionField, BeforeTheWindowItSaysNothingAndBehindItCarriesTheLastDelta) {
  const CorrectionField field(shifted(500, 1500, 100, 1), originals(kNever));
  EXPECT_EQ(apply(field, at(499), originalAt(499), 1).coverage, Coverage::kNone);
  const auto carried = apply(field, at(1700), originalAt(1700), 1);
  ASSERT_EQ(carried.coverage, Coverage::kCarried);
  expectSame(carried.T_W_B, kDelta * originalAt(1700));
}

TEST(CorrectionField, BehindTheWindowTheNewWorldNeedsNoCorrection) {
  const PoseBuffer poses = originals(1600);
  const CorrectionField field(shifted(500, 1500, 100, 2), poses);
  const auto old_world = apply(field, at(1590), originalAt(1590), 1);
  ASSERT_EQ(old_world.coverage, Coverage::kCarried);
  expectSame(old_world.T_W_B, kDelta * originalAt(1590));
  const Pose T_W_B_new = kDelta * originalAt(1600);
  const auto new_world = apply(field, at(1600), T_W_B_new, 2);
  ASSERT_EQ(new_world.coverage, Coverage::kCarried);
  expectSame(new_world.T_W_B, T_W_B_new);
  EXPECT_EQ(apply(field, at(1700), T_W_B_new, 3).coverage, Coverage::kNone) << "a third world";
}

TEST(CorrectionField, AJumpInsideTheWindowIsNotSmearedOverItsNeighbours) {
  const PoseBuffer poses = originals(1000);
  const CorrectionField field(shifted(0, 2000, 400, 2), poses);  // stamps 800 and 1200 lie around the jump
  for (std::int64_t ms = 0; ms <= 2000; ms += 10) {
    const auto original = poses.interpolate(at(ms));
    const auto corrected = apply(field, at(ms), original.T_W_B, original.epoch);
    ASSERT_EQ(corrected.coverage, Coverage::kInside) << ms;
    expectSame(corrected.T_W_B, kDelta * originalAt(ms));
  }
}

TEST(CorrectionField, LeavesOutPosesWithoutAnOriginal) {
  const CorrectionField field(shifted(1500, 2500, 100, 1), originals(kNever));
  EXPECT_EQ(field.anchorCount(), 6U);
  EXPECT_TRUE(CorrectionField(shifted(2100, 2500, 100, 1), originals(kNever)).empty());
}

TEST(CorrectionField, AWalkFindsWhatEveryLookupFinds) {
  const PoseBuffer poses = originals(1000);
  for (const std::int64_t step_ms : {30, 400}) {
    const CorrectionField field(shifted(105, 1800, step_ms, 2), poses);
    CorrectionField::Walk walk(field);
    for (std::int64_t ms = 0; ms <= 2000; ms += 5) {
      for (const std::uint32_t epoch : {1U, 2U}) {
        const CorrectionField::Delta expected = field.deltaAt(at(ms), epoch);
        const CorrectionField::Delta got = walk.deltaAt(at(ms), epoch);
        EXPECT_EQ(got.coverage, expected.coverage) << ms;
        EXPECT_EQ(got.from, expected.from) << ms;
        EXPECT_EQ(got.to, expected.to) << ms;
        EXPECT_EQ(got.weight, expected.weight) << ms;
      }
    }
  }
}

TEST(CorrectionField, AssignedAgainHoldsNothingOfTheOneBefore) {
  const PoseBuffer poses = originals(1000);
  CorrectionField field(shifted(0, 2000, 10, 2), poses);
  field.assign(shifted(500, 900, 100, 1), poses);
  EXPECT_EQ(field.anchorCount(), 5U);
  EXPECT_EQ(field.deltaAt(at(400), 1).coverage, Coverage::kNone);
  EXPECT_EQ(field.deltaAt(at(1500), 2).coverage, Coverage::kNone);
  expectSame(apply(field, at(650), originalAt(650), 1).T_W_B, kDelta * originalAt(650));
}

TEST(CheckCorrection, NamesWhatIsWrong) {
  EXPECT_EQ(checkCorrection({}), CorrectionVerdict::kEmpty);
  Correction correction = shifted(0, 200, 100, 1);
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kAccepted);
  std::swap(correction.poses[0], correction.poses[1]);
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kNotOrdered);
  correction = shifted(0, 200, 100, 1);
  correction.poses[1].stamp = correction.poses[0].stamp;
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kNotOrdered);
  correction = shifted(0, 200, 100, 1);
  correction.poses[2].T_W_B.translation_m.y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kNotFinite);
  correction = shifted(0, 200, 100, 1);
  correction.poses[2].T_W_B.rotation.coeffs() *= 1.1;
  EXPECT_EQ(checkCorrection(correction), CorrectionVerdict::kNotUnit);
}

}  // namespace
}  // namespace nanomap
