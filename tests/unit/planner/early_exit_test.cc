#include <gtest/gtest.h>

#include <random>

#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

constexpr int kScenes = 120;

/// Drawn within braces alone, where the order is the same for every compiler: so are the scenes.
test::DrawnWorld randomWorld(std::mt19937& random) {
  std::uniform_real_distribution<double> ahead_m(1.0, 14.0);
  std::uniform_real_distribution<double> aside_m(-8.0, 8.0);
  std::uniform_real_distribution<double> width_m(0.2, 1.5);
  test::DrawnWorld world;
  const int blocks = std::uniform_int_distribution<int>(0, 12)(random);
  for (int i = 0; i < blocks; ++i) {
    const Vec3 low{ahead_m(random), aside_m(random), 0.0};
    world.blocks.push_back({low, low + Vec3{width_m(random), width_m(random), 8.0}});
  }
  return world;
}

void expectSameMotion(const Trajectory& a, const Trajectory& b) {
  ASSERT_EQ(a.pieces().size(), b.pieces().size());
  for (std::size_t i = 0; i < a.pieces().size(); ++i) {
    EXPECT_EQ(a.pieces()[i].duration_s, b.pieces()[i].duration_s);
    EXPECT_EQ(a.pieces()[i].jerk_W_m_s3, b.pieces()[i].jerk_W_m_s3);
  }
}

/// The best of what is feasible when everything has been asked of every candidate.
std::optional<std::uint32_t> bestOf(const std::vector<CandidateExplanation>& candidates) {
  const CandidateExplanation* best = nullptr;
  for (const CandidateExplanation& candidate : candidates) {
    if (!candidate.verdict.veto && (best == nullptr || candidate.objective > best->objective)) best = &candidate;
  }
  return best == nullptr ? std::nullopt : std::optional(best->proposal.index);
}

/// Would it be feasible if nothing lay beside the views that answer?
bool isVetoedByWhatLiesBeside(const CandidateExplanation& candidate, double max_risk) {
  if (!candidate.verdict.veto || candidate.verdict.veto->status) return false;
  double survival = 1.0;
  for (const SampleEvidence& sample : candidate.evidence.motion) {
    survival *= (1.0 - sample.prior) * (1.0 - sample.collision_probability);
  }
  return 1.0 - survival <= max_risk && !candidate.verdict.vetoedByBrake();
}

/// Random scenes, motions and goals, with risks from zero to certain, under rules that make ties and mixed risks.
TEST(EarlyExit, ChangesNoDecision) {
  std::uint32_t evaluated_early = 0;
  std::uint32_t evaluated_all = 0;
  std::uint32_t flying = 0;
  int beside = 0;
  for (unsigned seed = 0; seed < kScenes; ++seed) {
    SCOPED_TRACE(seed);
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    PlannerParameters parameters = test::flightParameters();
    parameters.risk.max_risk = seed % 3 == 0 ? 0.3 : 0.001;
    parameters.stop_check = seed % 5 == 0 ? StopCheck::kPaper : StopCheck::kVerified;
    if (seed % 7 == 0) parameters.risk.prior[static_cast<std::size_t>(Status::kPartial)] = 0.01;
    test::Flight flight{randomWorld(random), {0.0, 0.0, 2.0}, 0.1 * normal(random), parameters};
    Motion motion{{0.0, 0.0, 2.0}, {1.0 + normal(random), normal(random), 0.2 * normal(random)}, Vec3::Zero()};
    if (seed % 2 == 0) motion.velocity_m_s.setZero();
    flight.setMotion(motion);
    if (seed % 2 == 1) flight.fly(test::goalAt({20.0, 0.0, 2.0}), 1.0);
    flight.look();
    const double height_m = seed % 6 == 1 ? 90.0 : 2.0;  // worth less than a collision
    const Goal goal = test::goalAt({20.0, 5.0 * normal(random), height_m});

    const Decision early = Planner(parameters).plan(flight.snapshot(), flight.state(), goal, flight.now());
    parameters.early_exit = false;
    const Decision all = Planner(parameters).plan(flight.snapshot(), flight.state(), goal, flight.now());
    EXPECT_EQ(early.candidate, all.candidate);
    EXPECT_EQ(early.reason, all.reason);
    EXPECT_EQ(early.risk, all.risk);
    EXPECT_EQ(early.brake_risk, all.brake_risk);
    EXPECT_EQ(early.brake_verified, all.brake_verified);
    EXPECT_EQ(early.yaw_W_rad, all.yaw_W_rad);
    expectSameMotion(early.trajectory, all.trajectory);
    expectSameMotion(early.brake, all.brake);
    const Explanation everything = Planner(parameters).explain(flight.snapshot(), flight.state(), goal, flight.now());
    const std::optional<std::uint32_t> best = bestOf(everything.candidates);
    if (best) {
      EXPECT_EQ(early.candidate, *best);
    } else {
      EXPECT_TRUE(early.reason == Reason::kRetreating || early.reason == Reason::kNothingVerified);
    }
    for (const CandidateExplanation& candidate : everything.candidates) {
      beside += isVetoedByWhatLiesBeside(candidate, parameters.risk.max_risk) ? 1 : 0;
    }
    evaluated_early += early.evaluated;
    evaluated_all += all.evaluated;
    flying += early.reason == Reason::kFlying ? 1 : 0;
  }
  EXPECT_EQ(evaluated_all, kScenes * kCandidateCount);
  EXPECT_LT(evaluated_early, evaluated_all / 2) << "it saves work";
  EXPECT_GT(flying, kScenes / 4) << "the scenes decide something";
  EXPECT_GT(beside, 5) << "and what lies beside a view does";
}

}  // namespace
}  // namespace nanomap
