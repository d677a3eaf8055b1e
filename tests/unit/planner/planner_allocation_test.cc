#include <gtest/gtest.h>

#include "planner/trajectory_risk.h"
#include "tests/support/allocations.h"
#include "tests/unit/planner/flight.h"

namespace nanomap {
namespace {

/// Nearest points from a list of one: allocates nothing, as FLANN does.
class OnePoint final : public NearestPointIndex {
 public:
  [[nodiscard]] std::size_t nearest(const Vec3f& p_C, std::span<Neighbour> out,
                                    float /*max_distance_m*/) const override {
    const Vec3f point_C(0.5F, 0.0F, 6.0F);
    out[0] = {point_C, (point_C - p_C).norm()};
    return 1;
  }
  [[nodiscard]] std::size_t size() const override { return 1; }
};

TEST(PlannerAllocation, APlanAllocatesNothingOfItsOwn) {
  const test::Flight flight(test::DrawnWorld{}, {0.0, 0.0, 2.0}, 0.0);
  const auto camera = test::model(test::flightCamera());
  ChainSnapshot snapshot;
  SnapshotView view;
  view.view = std::make_shared<const View>(test::flatImage(*camera, 9000), camera, std::make_unique<const OnePoint>());
  view.R_C_B = camera->parameters().T_B_C.rotation.conjugate().toRotationMatrix();
  snapshot.views.push_back(view);
  VehicleState state;
  std::optional<Goal> goal = test::goalAt({20.0, 3.0, 0.0});

  for (const bool early_exit : {true, false}) {
    for (const CollisionModel model :
         {CollisionModel::kBall, CollisionModel::kGaussianVolume, CollisionModel::kHalfSpaces}) {
      PlannerParameters parameters = test::flightParameters();
      parameters.early_exit = early_exit;
      parameters.risk.collision.model = model;
      const Planner planner(parameters);
      const std::size_t before = test::allocationCount();
      const Decision decision = planner.plan(snapshot, state, goal, Time{});
      EXPECT_EQ(test::allocationCount(), before);
      EXPECT_GE(decision.evaluated, early_exit ? 1U : kCandidateCount);
    }
  }
}

}  // namespace
}  // namespace nanomap
