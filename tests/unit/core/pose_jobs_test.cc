#include "core/pose_jobs.h"

#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "tests/support/instruction_sets.h"

namespace nanomap {
namespace {

/// Of coordinates within kFarthest_m, and of unit quaternions.
constexpr double kRoundings_m = 4e-13;
constexpr double kRoundings = 2e-15;
constexpr double kFarthest_m = 50.0;

/// What jobs read and write.
struct Work {
  Pose from;
  Pose to;
  double weight = 0.0;
  Pose pose;
  Pose result;
};

std::vector<PoseJob> jobsOf(std::vector<Work>& work) {
  std::vector<PoseJob> jobs;
  for (Work& w : work) jobs.push_back({&w.from, w.weight, &w.to, &w.pose, &w.result});
  return jobs;
}

/// Poses anywhere; the two ends of a job lie up to `turn_rad` apart, or just that.
class RandomWork {
 public:
  std::vector<Work> operator()(std::size_t count, double turn_rad) {
    std::vector<Work> work(count);
    for (std::size_t i = 0; i < count; ++i) {
      Work& w = work[i];
      w.from = pose();
      w.to = pose();
      const double angle_rad = i % 3 == 0 ? turn_rad : turn_rad * share_(random_);
      w.to.rotation = w.from.rotation * Quat(Eigen::AngleAxisd(angle_rad, pose().rotation.vec().normalized()));
      if (i % 2 == 0) w.to.rotation.coeffs() *= -1.0;
      w.weight = i % 5 == 0 ? static_cast<double>(i % 2) : share_(random_);
      w.pose = pose();
    }
    return work;
  }

 private:
  Pose pose() {
    return {Quat(normal_(random_), normal_(random_), normal_(random_), normal_(random_)).normalized(),
            kFarthest_m * Vec3(offset_(random_), offset_(random_), offset_(random_))};
  }

  std::mt19937 random_{17};
  std::normal_distribution<double> normal_;
  std::uniform_real_distribution<double> share_{0.0, 1.0};
  std::uniform_real_distribution<double> offset_{-1.0, 1.0};
};

Pose interpolatedByEigen(const Work& work) {
  return {work.from.rotation.slerp(work.weight, work.to.rotation),
          (1.0 - work.weight) * work.from.translation_m + work.weight * work.to.translation_m};
}

void expectSame(const Pose& got, const Eigen::Isometry3d& expected) {
  EXPECT_LT((got.translation_m - expected.translation()).norm(), kRoundings_m);
  EXPECT_LT((got.rotation.toRotationMatrix() - expected.linear()).norm(), 4.0 * kRoundings);
  EXPECT_NEAR(got.rotation.norm(), 1.0, kRoundings);
}

Eigen::Isometry3d isometry(const Pose& pose) { return Eigen::Translation3d(pose.translation_m) * pose.rotation; }

/// Counts around those of every vector; turns on both sides of the series' end, and up to half a turn.
constexpr std::size_t kCounts[] = {0, 1, 2, 3, 4, 5, 7, 8, 9, 16, 17, 200};
constexpr double kTurns_rad[] = {0.0, 1e-9, 1e-3, 0.12, 0.126, 0.5, 2.0, 3.1};

TEST(PoseJobs, AreWhatEigenMakesOfThem) {
  RandomWork random_work;
  for (const std::int64_t target : test::instructionSets()) {
    const test::OnInstructionSet on(target);
    for (const std::size_t count : kCounts) {
      for (const double turn_rad : kTurns_rad) {
        SCOPED_TRACE(testing::Message() << target << ": " << count << " turns by " << turn_rad);
        std::vector<Work> work = random_work(count, turn_rad);
        makeDeltas(jobsOf(work));
        for (const Work& w : work) expectSame(w.result, isometry(w.pose) * isometry(interpolatedByEigen(w)).inverse());
        applyDeltas(jobsOf(work));
        for (const Work& w : work) expectSame(w.result, isometry(interpolatedByEigen(w)) * isometry(w.pose));
      }
    }
  }
}

TEST(PoseJobs, AreTheSameBitsOnEveryInstructionSet) {
  std::vector<Work> work = RandomWork()(101, 0.3);
  std::vector<Pose> expected;
  makeDeltas(jobsOf(work));
  for (const Work& w : work) expected.push_back(w.result);
  for (const std::int64_t target : test::instructionSets()) {
    const test::OnInstructionSet on(target);
    makeDeltas(jobsOf(work));
    for (std::size_t i = 0; i < work.size(); ++i) EXPECT_EQ(work[i].result, expected[i]) << target << ' ' << i;
  }
}

TEST(PoseJobs, RotationsOfAboutUnitNormMakeUnitDeltas) {
  std::vector<Work> work = RandomWork()(9, 0.01);
  for (Work& w : work) w.pose.rotation.coeffs() *= 1.0 + 0.9 * kUnitNormTolerance;
  makeDeltas(jobsOf(work));
  for (const Work& w : work) EXPECT_NEAR(w.result.rotation.norm(), 1.0, kRoundings);
}

}  // namespace
}  // namespace nanomap
