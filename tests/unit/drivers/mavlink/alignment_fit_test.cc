#include "drivers/mavlink/alignment_fit.h"

#include <gtest/gtest.h>

#include "tests/unit/drivers/mavlink/alignment_pairs.h"

namespace nanomap {
namespace {

using namespace std::chrono_literals;
using test::trueAlignment;
using test::TwoEstimators;

constexpr std::size_t kPairs = 200;

RingBuffer<AlignmentPair> windowOf(TwoEstimators& estimators, std::size_t count = kPairs) {
  RingBuffer<AlignmentPair> window(count);
  for (std::size_t i = 0; i < count; ++i) window.pushBack(estimators.pair(Time(i * 50ms)));
  return window;
}

double headingError(const NedFromWorld& T_NED_W) {
  return std::abs(wrapAngle(T_NED_W.heading_rad() - trueAlignment().heading_rad()));
}

TEST(AlignmentFit, OfPerfectPairsIsTheTruth) {
  TwoEstimators estimators;
  const auto window = windowOf(estimators);
  const NedFromWorld T_NED_W = fitAlignment(window, {});
  EXPECT_LT(headingError(T_NED_W), 1e-9);
  EXPECT_LT((T_NED_W.pose().translation_m - trueAlignment().pose().translation_m).norm(), 1e-9);
  EXPECT_LT(medianResiduals(window, T_NED_W).position_m, 1e-9);
}

TEST(AlignmentFit, OfOnePairIsItsOwn) {
  TwoEstimators estimators;
  const auto window = windowOf(estimators, 1);
  EXPECT_LT(residualsOf(window[0], fitAlignment(window, {})).position_m, 1e-9);
}

TEST(AlignmentFit, OfAHoveringVehicleTakesTheHeadingFromTheAttitudes) {
  TwoEstimators estimators(0.0);
  estimators.position_noise_m = 0.05;
  estimators.heading_noise_rad = 0.02;
  const NedFromWorld T_NED_W = fitAlignment(windowOf(estimators), {});
  EXPECT_LT(headingError(T_NED_W), 0.01);
  const Vec3 at_W{5.0, 0.0, 2.0};
  EXPECT_LT((T_NED_W.point(at_W) - trueAlignment().point(at_W)).norm(), 0.05);
}

TEST(AlignmentFit, ShrugsOffNoiseAndAThirdOfOutliers) {
  TwoEstimators estimators;
  estimators.position_noise_m = 0.1;
  estimators.heading_noise_rad = 0.05;
  auto window = windowOf(estimators);
  for (std::size_t i = 0; i < window.size() / 3; ++i) {
    window[i].position_NED_m += Vec3(30.0, -12.0, 5.0);
    window[i].heading_NED_rad += 2.0;
  }
  EXPECT_LT(headingError(fitAlignment(window, {.attitude_sigma_rad = 1.0})), 0.1);  // by the tracks
  const NedFromWorld T_NED_W = fitAlignment(window, {});
  EXPECT_LT(headingError(T_NED_W), 0.1);
  const Vec3& at_W = window[window.size() - 1].position_W_m;
  EXPECT_LT((T_NED_W.point(at_W) - trueAlignment().point(at_W)).norm(), 0.5);
}

TEST(AlignmentFit, TrustsLongTracksMoreThanACompass) {
  TwoEstimators compass_is_off;
  compass_is_off.compass_error_rad = 0.1;
  const auto circle = windowOf(compass_is_off);
  const double by_circle_rad = headingError(fitAlignment(circle, {}));
  EXPECT_LT(by_circle_rad, 0.08);
  const double by_trusted_tracks_rad = headingError(fitAlignment(circle, {.attitude_sigma_rad = 1.0}));
  EXPECT_LT(by_trusted_tracks_rad, 0.005);
  EXPECT_GT(headingError(fitAlignment(circle, {.position_sigma_m = 100.0})), 0.099);
}

TEST(AlignmentFit, IsPlacedByTheNewestPairsAlone) {
  TwoEstimators estimators;
  auto window = windowOf(estimators);
  const Vec3 drifted_m(0.4, -0.3, 0.2);
  for (std::size_t i = window.size() - 11; i < window.size(); ++i) window[i].position_NED_m += drifted_m;
  const Vec3 truth_m = trueAlignment().pose().translation_m;
  const auto placed = [&](Duration newest) { return placedByNewest(window, test::kHeading_rad, newest); };
  EXPECT_LT((placed(500ms).pose().translation_m - (truth_m + drifted_m)).norm(), 1e-9);
  EXPECT_LT((placed(0ms).pose().translation_m - (truth_m + drifted_m)).norm(), 1e-9);  // one pair is enough
  EXPECT_LT((placed(10s).pose().translation_m - truth_m).norm(), 1e-9);
  EXPECT_LT(headingError(placed(500ms)), 1e-9);
}

TEST(AlignmentFit, OfHeadingsAroundSouthDoesNotAverageAcrossTheWrap) {
  TwoEstimators estimators;
  estimators.T_NED_W = NedFromWorld(std::numbers::pi, Vec3::Zero());
  estimators.heading_noise_rad = 0.05;
  EXPECT_LT(std::abs(wrapAngle(fitAlignment(windowOf(estimators), {}).heading_rad() - std::numbers::pi)), 0.02);
}

}  // namespace
}  // namespace nanomap
