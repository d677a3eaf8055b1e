#include "core/drift.h"

namespace nanomap {

Vec3 DriftModel::variance_W(Duration age) const {
  if (age <= Duration::zero()) return Vec3::Zero();
  const double share = toSeconds(age) / toSeconds(after);
  const double growth = law == GrowthLaw::kSquareRoot ? share : share * share;
  const Vec3 std_m(horizontal_std_m, horizontal_std_m, vertical_std_m);
  return growth * std_m.cwiseAbs2();
}

}  // namespace nanomap
