#include "tests/bench/rows/certified_survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>

#include "core/drift.h"
#include "core/query.h"
#include "tests/bench/report/contest.h"
#include "tests/bench/rows/chain_fixture.h"
#include "tools/generate/paper_camera.h"
#include "tools/replay/percentile.h"
#include "tools/simulation/scene_catalogue.h"
#include "tools/simulation/vio.h"

namespace nanomap::bench {
namespace {

constexpr std::uint64_t kSeed = 1;

/// The same flight, as an estimator sees it whose position drifts as the chain takes it to.
RecordedFlight drifting(RecordedFlight flight) {
  simulation::VioSimulator estimator({.drift = DriftModel{}}, kSeed);
  for (BodyPose& pose : flight.poses) {
    simulation::VehicleState truth;
    truth.T_W_B = pose.T_W_B;
    pose.T_W_B = estimator.estimate(pose.stamp, truth).pose.T_W_B;
  }
  return flight;
}

using Draw = std::function<Vec3(std::mt19937&)>;

/// Uniform in the frustum.
Draw inView(const SnapshotView& view) {
  return [&view](std::mt19937& random) -> Vec3 {
    std::uniform_real_distribution<double> share;
    const Frustum& f = view.view->camera().frustum();
    const double z_m = f.far_m * std::cbrt(share(random));
    const double tan_x = std::lerp(f.tan_left, f.tan_right, share(random));
    const double tan_y = std::lerp(f.tan_top, f.tan_bottom, share(random));
    return view.R_C_B.transpose() * (z_m * Vec3(tan_x, tan_y, 1.0) - view.t_C_B_m);
  };
}

/// Uniform in a ball around the vehicle.
Draw aroundVehicle() {
  return [](std::mt19937& random) -> Vec3 {
    std::normal_distribution<double> normal;
    std::uniform_real_distribution<double> share;
    const double x = normal(random);
    const double y = normal(random);
    const Vec3 direction = Vec3(x, y, normal(random)).normalized();
    return kSurveyReach_m * std::cbrt(share(random)) * direction;
  };
}

/// What is true and what is said of one place.
struct Place {
  double true_m;
  double nearest_m;
  double certified_m;
};

CertifiedFigures::Over shareOver(const std::vector<Place>& places, double Place::*said_m) {
  const auto over = [&](double by_m) {
    const auto count =
        std::ranges::count_if(places, [&](const Place& place) { return place.*said_m > place.true_m + by_m; });
    return static_cast<double>(count) / static_cast<double>(places.size());
  };
  return {over(0.1), over(0.5)};
}

double timeOf_s(const ChainSnapshot& snapshot, const std::vector<UncertainPoint>& points_B,
                const QueryOptions& options) {
  const double start_s = threadTime_s();
  for (const UncertainPoint& x_B : points_B) {
    (void)nearestAt(snapshot, locate(snapshot, x_B, options), x_B, options, static_cast<float>(kSurveyReach_m));
  }
  return threadTime_s() - start_s;
}

CertifiedFigures figuresOf(const ChainSnapshot& snapshot, const std::function<double(const Vec3&)>& clearance_m,
                           const Draw& draw, std::size_t count) {
  std::mt19937 random(kSeed);
  const QueryOptions plain;
  const QueryOptions certifying{.certify = true};
  std::vector<UncertainPoint> points_B;
  std::vector<Place> places;
  while (points_B.size() < count) {
    const UncertainPoint x_B{draw(random), Mat3::Zero()};
    const double true_m = clearance_m(x_B.mean_m);
    if (true_m <= 0.0) continue;
    const Location location = locate(snapshot, x_B, plain);
    if (!endsSearch(location.status)) continue;
    const QueryReply reply = nearestAt(snapshot, location, x_B, certifying, static_cast<float>(kSurveyReach_m));
    const double nearest_m =
        reply.found().empty() ? kSurveyReach_m : static_cast<double>(reply.found().front().distance_m);
    points_B.push_back(x_B);
    places.push_back({std::min(true_m, kSurveyReach_m), nearest_m, reply.certified->radius_m});
  }

  CertifiedFigures figures;
  figures.points = places.size();
  figures.nearest = shareOver(places, &Place::nearest_m);
  figures.certified = shareOver(places, &Place::certified_m);
  std::vector<double> of_all;
  std::vector<double> of_certified;
  for (const Place& place : places) {
    of_all.push_back(place.certified_m / place.true_m);
    if (place.certified_m > 0.0) of_certified.push_back(of_all.back());
  }
  figures.median_of_all = percentile<double>(of_all, 0.5);
  if (!of_certified.empty()) figures.median = percentile<double>(of_certified, 0.5);
  figures.unanswered = static_cast<double>(of_all.size() - of_certified.size()) / static_cast<double>(of_all.size());
  figures.cost = timeOf_s(snapshot, points_B, certifying) / timeOf_s(snapshot, points_B, plain);
  return figures;
}

}  // namespace

std::vector<CertifiedFigures> surveyCertificates(std::string_view name, Noise noise, std::size_t history,
                                                 std::size_t count) {
  const simulation::Scene scene = simulation::makeScene(name, kSeed);
  const RecordedFlight truth = GeneratedScene(name).fly(generate::paperCamera(320, 240), noise, {0, history + 1});
  const RecordedFlight flight = drifting(truth);
  const ChainFixture chain(flight, history);
  const Pose T_W_B = truth.poses.back().T_W_B;
  const auto clearance_m = [&](const Vec3& p_B) {
    const Vec3 p_W = T_W_B * p_B;
    return std::min(p_W.z(), scene.distanceToNearestObstacle(p_W));
  };
  const std::string where = std::string(name) + (noise == Noise::kClean ? " clean" : " noisy");
  std::vector<CertifiedFigures> figures = {
      figuresOf(chain.after, clearance_m, inView(chain.after.views.front()), count),
      figuresOf(chain.after, clearance_m, aroundVehicle(), count)};
  figures[0].where = where + ", in view";
  figures[1].where = where + ", around";
  return figures;
}

void print(const std::vector<CertifiedFigures>& figures) {
  fmt::print("{:28} {:>7} {:>17} {:>17} {:>7} {:>7} {:>11} {:>6}\n", "", "", "nearest over by", "certified over by",
             "median", "of all", "", "");
  fmt::print("{:28} {:>7} {:>8} {:>8} {:>8} {:>8} {:>15} {:>11} {:>6}\n", "points", "count", "0.1 m", "0.5 m", "0.1 m",
             "0.5 m", "certified/true", "unanswered", "cost");
  for (const CertifiedFigures& row : figures) {
    fmt::print("{:28} {:>7} {:>7.2f}% {:>7.2f}% {:>7.2f}% {:>7.2f}% {:>7.2f} {:>7.2f} {:>10.1f}% {:>5.1f}x\n",
               row.where, row.points, 1e2 * row.nearest.by_0_1_m, 1e2 * row.nearest.by_0_5_m,
               1e2 * row.certified.by_0_1_m, 1e2 * row.certified.by_0_5_m, row.median, row.median_of_all,
               1e2 * row.unanswered, row.cost);
  }
}

}  // namespace nanomap::bench
