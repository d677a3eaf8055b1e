#include "core/drift.h"

#include <gtest/gtest.h>

namespace nanomap {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

DriftModel model(GrowthLaw law) {
  return {.horizontal_std_m = 0.7, .vertical_std_m = 0.1, .after = seconds(5), .law = law};
}

TEST(DriftModel, EqualsTheConfiguredDeviationAtTheConfiguredTime) {
  for (const GrowthLaw law : {GrowthLaw::kSquareRoot, GrowthLaw::kLinear}) {
    const Vec3 variance_m2 = model(law).variance_W(seconds(5));
    EXPECT_DOUBLE_EQ(variance_m2.x(), 0.7 * 0.7);
    EXPECT_DOUBLE_EQ(variance_m2.y(), 0.7 * 0.7);
    EXPECT_DOUBLE_EQ(variance_m2.z(), 0.1 * 0.1);
  }
}

TEST(DriftModel, GrowsByItsLaw) {
  const double full_m2 = 0.7 * 0.7;
  EXPECT_DOUBLE_EQ(model(GrowthLaw::kSquareRoot).variance_W(milliseconds(2500)).x(), full_m2 / 2.0);
  EXPECT_DOUBLE_EQ(model(GrowthLaw::kLinear).variance_W(milliseconds(2500)).x(), full_m2 / 4.0);
}

TEST(DriftModel, IsZeroNowAndBefore) {
  EXPECT_EQ(model(GrowthLaw::kLinear).variance_W(Duration::zero()), Vec3::Zero());
  EXPECT_EQ(model(GrowthLaw::kSquareRoot).variance_W(-seconds(1)), Vec3::Zero());
}

}  // namespace
}  // namespace nanomap
