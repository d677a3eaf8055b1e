#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/classify.h"
#include "core/query.h"
#include "core/trajectory.h"
#include "planner/aside.h"
#include "planner/collision_probability.h"

namespace nanomap {

/// How uncertain the vehicle is about where it will be: a standard deviation in each horizontal direction or vertically
/// that grows with speed and time. Where it is beside its motion when a plan starts is known (planner/aside.h), so this
/// is of the rest. The defaults are what the simulated vehicle of tools/sim strays by from where it was expected
/// (tools/sim/README.md): its speed hardly matters, the time does. A heavier vehicle needs its own. The authors' are
/// larger and have no term of time.
struct DeviationGrowth {
  double base_m = 0.0;
  double per_speed_s = 0.0;
  double per_time_m_s = 0.0;

  [[nodiscard]] double at(double speed_m_s, double elapsed_s) const {
    return base_m + per_speed_s * speed_m_s + per_time_m_s * elapsed_s;
  }
};

/// Collision probability before any neighbour is looked at, by status. Free and open cost nothing, so that a vehicle
/// takes off in an empty field; each of the others is a veto, so that it does not fly into a hole.
[[nodiscard]] constexpr std::array<double, kStatusCount> defaultPriors() {
  std::array<double, kStatusCount> priors{};
  priors.fill(1.0);
  priors[static_cast<std::size_t>(Status::kFree)] = 0.0;
  priors[static_cast<std::size_t>(Status::kOpen)] = 0.0;
  return priors;
}

struct RiskParameters {
  double max_risk = 0.001;  ///< the chance constraint of the paper
  DeviationGrowth horizontal{.base_m = 0.04, .per_speed_s = 0.002, .per_time_m_s = 0.03};
  DeviationGrowth vertical{.base_m = 0.04, .per_speed_s = 0.002, .per_time_m_s = 0.03};
  double bubble_margin_m = 0.2;  ///< beyond the vehicle's radius: where no frustum reaches
  CollisionParameters collision;
  QueryOptions query;

  /// The view that answers need not know all that is near. Where it holds less than the vehicle around the place, what
  /// is near may lie just beside it: the newest view with room for the vehicle is asked as well. Where newer views
  /// could not answer (a hole among depths, say), they may all the same have measured what is near: the newest that
  /// holds the place is asked as well, and no other, though it may be a frame without any depth. Without it, the
  /// paper's answer alone.
  bool look_beside = true;
  /// Farther than this from the vehicle, a place that no view has room around may have anything beside it. Nearer, most
  /// places are such while it stands.
  double beside_beyond_m = 3.0;

  /// Space that no view has seen empty may hold anything: what reaches it counts as a collision. Only then does the
  /// constraint hold for obstacles outside the view that answers, or hidden in it; narrow passages stay closed.
  bool demand_certificate = false;
  /// Not of places nearer than this to the vehicle, beside which a camera that stands still never looks.
  double certificate_beyond_m = 2.0;

  std::array<double, kStatusCount> prior = defaultPriors();
};

/// What another view has measured near a place than the one that answers.
struct SecondLook {
  bool asked = false;
  std::optional<std::uint32_t> view_index;  ///< in the snapshot, 0 the newest; none: there is no such view
  std::optional<double> nearest_m;          ///< as of SampleEvidence
  double collision_probability = 0.0;       ///< from the neighbours there
};

/// What is known about one moment of a trajectory.
struct SampleEvidence {
  double elapsed_s = 0.0;
  Vec3 position_W_m = Vec3::Zero();  ///< where the vehicle is expected: beside its motion, if it was before
  Status status = Status::kEmpty;
  std::optional<std::uint32_t> view_index;  ///< in the snapshot, 0 the newest
  std::optional<double> nearest_m;     ///< to the nearest measured point of that view, if it is near enough to matter
  bool in_bubble = false;              ///< judged by its neighbours alone
  double prior = 0.0;                  ///< from the status; 0 in the bubble
  double collision_probability = 0.0;  ///< from the neighbours
  double unseen_probability = 0.0;     ///< of reaching what no view has seen, as far as that must be known
  bool cramped = false;    ///< the view that answers has no room for the vehicle there, and no other was asked
  bool overtaken = false;  ///< there are newer views than the one that answers, and none was asked
  SecondLook beside;       ///< the newest view that has room around the place for the vehicle
  SecondLook newer;        ///< the newest view that holds the place, if that is newer than the one that answers
  double risk = 0.0;       ///< of all

  /// Distance to the nearest measured point; infinite if there is none that matters.
  [[nodiscard]] double distance_m() const {
    constexpr double kNone = std::numeric_limits<double>::infinity();
    return std::min({nearest_m.value_or(kNone), beside.nearest_m.value_or(kNone), newer.nearest_m.value_or(kNone)});
  }

  [[nodiscard]] bool needsSecondLook() const { return cramped || overtaken; }

  /// Free or open, or where the vehicle is anyway: a place to stand still.
  [[nodiscard]] bool seenFree() const { return in_bubble || endsSearch(status); }

  /// A place to fly on from: the bubble moves with the vehicle, and is no reason to follow it where nothing was seen.
  [[nodiscard]] bool leadsOut() const { return !in_bubble || endsSearch(status); }
};

/// What weighed most against something: a status, or measured points where there is none. Space that is not certified,
/// or that no view has room around, counts as kPartial: only part of what the place may be was seen.
struct VetoCause {
  std::optional<Status> status;
};

struct TrajectoryRisk {
  double risk = 0.0;              ///< 1 - prod(1 - p_sample); if evaluation stopped early, of the samples up to there
  std::optional<VetoCause> veto;  ///< the risk is above the constraint
  double least_distance_m = std::numeric_limits<double>::infinity();  ///< of all samples
  double largest_prior = 0.0;                                         ///< of all samples
  SampleEvidence first;                                               ///< the trajectory's start
  SampleEvidence last;  ///< the trajectory's end, unless evaluation stopped early
  /// Bits of the samples that need one; the last stands for all that follow its own, too.
  std::uint64_t second_looks = 0;
};

/// Judges trajectories by what a snapshot knows. Borrows snapshot and parameters.
/// Allocates: no, except inside FLANN. Threads: any number of readers.
class SpaceAhead {
 public:
  /// @param aside  where the vehicle is beside all of the trajectories, which start at one time
  SpaceAhead(const ChainSnapshot& snapshot, const RiskParameters& parameters, const Aside& aside = {});

  /// A moment of a trajectory, `elapsed_s` after its start.
  /// @param stop_early  look for no neighbours where the status is a certain veto
  [[nodiscard]] SampleEvidence assess(const Motion& motion_W, double elapsed_s, bool stop_early = false) const;

  /// A whole trajectory, in five stretches of equal time and even steps along each: `samples` at least, and as many as
  /// leave none longer than the vehicle's radius (planner/stretches.h). So neither a thin obstacle nor a hole as wide
  /// as the vehicle falls between two samples. One that stands at its end, and is not back there from beside its motion
  /// by then, is followed until it is.
  /// @param stop_early  stop as soon as the risk is above the constraint
  /// @param evidence    if given, every sample is appended, in the order of evaluation (allocates)
  /// @param start       assess() of the trajectory's start, if that is known: many may start alike
  [[nodiscard]] TrajectoryRisk assess(const Trajectory& trajectory, int samples, bool stop_early,
                                      std::vector<SampleEvidence>* evidence = nullptr,
                                      const SampleEvidence* start = nullptr) const;

  /// Looks beside the views that answered, and into newer ones, for the samples that need it. Their risks, and that of
  /// `judged`, only rise.
  /// @param judged      assess()'s of the same trajectory, with the same number of samples
  /// @param stop_early  stop as soon as the risk is above the constraint
  /// @param evidence    assess()'s, of this trajectory alone
  void lookBeside(const Trajectory& trajectory, int samples, bool stop_early, TrajectoryRisk& judged,
                  std::vector<SampleEvidence>* evidence = nullptr) const;

  /// The same for one moment.
  void lookBeside(const Motion& motion_W, SampleEvidence& sample) const;

  /// The veto of the first of a few samples of assess(), far apart, that is above the constraint all by itself; empty
  /// if none is. Soon finds most of what assess() would veto after many. `first` and `last` are that sample.
  [[nodiscard]] std::optional<TrajectoryRisk> glance(const Trajectory& trajectory, int samples) const;

 private:
  struct Place;
  struct Near;

  template <class Visitor>
  void visit(const Trajectory& trajectory, int samples, Visitor&& visitor) const;
  [[nodiscard]] Place placeAt(const Motion& motion_W, double elapsed_s) const;
  [[nodiscard]] Near nearTo(const Place& place, const Location& location) const;
  [[nodiscard]] Mat3 covariance_B(double horizontal_std_m, double vertical_std_m) const;
  [[nodiscard]] double unseenProbability(const UncertainPoint& x_B, double reach_m) const;
  [[nodiscard]] SecondLook lookInto(const Place& place, const std::optional<std::uint32_t>& view_index) const;
  [[nodiscard]] bool hasRoom(const Near& near) const;

  const ChainSnapshot& snapshot_;
  const RiskParameters& parameters_;
  Aside aside_;
  QueryOptions with_room_;  ///< asks for views with room for the vehicle
  Mat3 R_B_W_;
};

}  // namespace nanomap
