#include "core/trajectory.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using std::chrono::milliseconds;

const Motion kStart{{1.0, 2.0, 3.0}, {1.0, 0.0, -1.0}, {0.0, 0.5, 0.0}};

Trajectory twoPieces() {
  Trajectory trajectory(Time(milliseconds(999'900)), kStart);
  trajectory.append(0.2, {10.0, 0.0, 0.0});
  trajectory.append(0.8, {0.0, -2.0, 1.0});
  return trajectory;
}

/// The jerk integrated three times in small steps.
Motion integrated(const Trajectory& trajectory, double elapsed_s) {
  constexpr double kStep_s = 1e-5;
  Motion motion = trajectory.atStart();
  double piece_begin_s = 0.0;
  for (const Trajectory::Piece& piece : trajectory.pieces()) {
    for (double t_s = piece_begin_s; t_s < std::min(piece_begin_s + piece.duration_s, elapsed_s) - kStep_s / 2.0;
         t_s += kStep_s) {
      motion.acceleration_m_s2 += piece.jerk_W_m_s3 * kStep_s;
      motion.velocity_m_s += motion.acceleration_m_s2 * kStep_s;
      motion.position_m += motion.velocity_m_s * kStep_s;
    }
    piece_begin_s += piece.duration_s;
  }
  return motion;
}

void expectNear(const Motion& a, const Motion& b, double tolerance) {
  EXPECT_LE((a.position_m - b.position_m).norm(), tolerance);
  EXPECT_LE((a.velocity_m_s - b.velocity_m_s).norm(), tolerance);
  EXPECT_LE((a.acceleration_m_s2 - b.acceleration_m_s2).norm(), tolerance);
}

TEST(Trajectory, AgreesWithNumericIntegration) {
  for (const double elapsed_s : {0.1, 0.2, 0.5, 1.0}) {
    expectNear(twoPieces().sample(elapsed_s), integrated(twoPieces(), elapsed_s), 1e-4);
  }
}

TEST(Trajectory, ClampsToItsStartAndEnd) {
  const Trajectory trajectory = twoPieces();
  expectNear(trajectory.sample(-1.0), kStart, 1e-15);
  expectNear(trajectory.sample(100.0), trajectory.atEnd(), 1e-15);
  EXPECT_DOUBLE_EQ(trajectory.duration_s(), 1.0);
}

TEST(Trajectory, WithoutPiecesStaysAtItsStart) {
  const Trajectory trajectory(Time{}, kStart);
  EXPECT_EQ(trajectory.duration_s(), 0.0);
  expectNear(trajectory.sample(1.0), kStart, 1e-15);
}

TEST(Trajectory, IsSampledByTimeAcrossASecondBoundary) {
  const Trajectory trajectory = twoPieces();
  expectNear(trajectory.sample(Time(milliseconds(1'000'400))), trajectory.sample(0.5), 1e-12);
  expectNear(trajectory.sample(Time(milliseconds(1))), kStart, 1e-15);
}

TEST(Trajectory, FirstPartIsTheSameMotionCutShort) {
  const Trajectory trajectory = twoPieces();
  for (const double cut_s : {-1.0, 0.0, 0.1, 0.2, 0.7, 1.0, 5.0}) {
    const Trajectory part = trajectory.firstPart(cut_s);
    EXPECT_NEAR(part.duration_s(), std::clamp(cut_s, 0.0, 1.0), 1e-15);
    expectNear(part.atEnd(), trajectory.sample(cut_s), 1e-15);
    EXPECT_EQ(part.start(), trajectory.start());
  }
}

TEST(Trajectory, RestIsTheSameMotionFromThenOn) {
  const Trajectory trajectory = twoPieces();
  for (const int passed_ms : {0, 100, 200, 700, 1000, 5000}) {
    const Time from = trajectory.start() + milliseconds(passed_ms);
    const Trajectory rest = trajectory.rest(from);
    EXPECT_EQ(rest.start(), from);
    EXPECT_NEAR(rest.duration_s(), std::max(1.0 - passed_ms / 1e3, 0.0), 1e-15);
    for (const int later_ms : {0, 50, 100, 600, 2000}) {
      const Time later = from + milliseconds(later_ms);
      expectNear(rest.sample(later), trajectory.sample(later), 1e-14);
    }
  }
}

TEST(TrajectorySampler, IsTheTrajectoryToTheLastBit) {
  const Trajectory trajectory = twoPieces();
  const TrajectorySampler sampler(trajectory);
  EXPECT_EQ(sampler.duration_s(), trajectory.duration_s());
  for (double elapsed_s = -0.1; elapsed_s < 1.2; elapsed_s += 0.01)
    expectNear(sampler.at(elapsed_s), trajectory.sample(elapsed_s), 0.0);
  for (const double elapsed_s : {0.2, 1.0}) expectNear(sampler.at(elapsed_s), trajectory.sample(elapsed_s), 0.0);
  EXPECT_EQ(TrajectorySampler(Trajectory(Time{}, kStart)).at(1.0).position_m, kStart.position_m);
}

TEST(Trajectory, LeavesOutPiecesOfNoLength) {
  Trajectory trajectory(Time{}, kStart);
  for (std::size_t i = 0; i < 2 * Trajectory::kMaxPieces; ++i) trajectory.append(0.0, Vec3::Ones());
  EXPECT_TRUE(trajectory.pieces().empty());
}

}  // namespace
}  // namespace nanomap
