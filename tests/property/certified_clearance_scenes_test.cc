#include <gtest/gtest.h>

#include <string>

#include "tests/bench/rows/certified_survey.h"

namespace nanomap {
namespace {

using bench::CertifiedFigures;
using bench::Noise;

struct Surveyed {
  std::string_view scene;
  Noise noise;
};

class CertificatesInScene : public testing::TestWithParam<Surveyed> {};

/// Against the scene's true clearance, from poses that drift. The nearest neighbour alone is what upstream answers
/// with.
TEST_P(CertificatesInScene, HardlyEverExceedTheTruthAndSayMostOfIt) {
  constexpr std::size_t kHistory = 90;
  constexpr std::size_t kPoints = 400;
  for (const CertifiedFigures& row : bench::surveyCertificates(GetParam().scene, GetParam().noise, kHistory, kPoints)) {
    SCOPED_TRACE(row.where);
    EXPECT_EQ(row.points, kPoints);
    EXPECT_LT(row.certified.by_0_5_m, 0.01);
    EXPECT_LT(row.certified.by_0_1_m, row.nearest.by_0_1_m);
    const bool around = row.where.ends_with("around");
    if (!around) continue;
    EXPECT_GT(row.nearest.by_0_5_m, 0.05);
    EXPECT_GT(row.median, 0.5);
    EXPECT_LT(row.unanswered, 0.15);
  }
}

INSTANTIATE_TEST_SUITE_P(Scene, CertificatesInScene,
                         testing::Values(Surveyed{"forest", Noise::kNoisy}, Surveyed{"warehouse", Noise::kNoisy}),
                         [](const auto& survey) { return std::string(survey.param.scene); });

}  // namespace
}  // namespace nanomap
