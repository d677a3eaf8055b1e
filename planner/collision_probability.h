#pragma once

#include <cstdint>
#include <span>

#include "core/geometry.h"
#include "core/nearest_point_index.h"

namespace nanomap {

/// How the chance of a collision is computed from the nearest measured points. The error of the vehicle's position is
/// e ~ N(0, Sigma), d a point's distance from the mean, r the vehicle's radius.
enum class CollisionModel : std::uint8_t {
  /// P(|e| > d_min - r): nothing measured is nearer than d_min, so a collision with anything measured, listed or not,
  /// needs at least that error. Never below the truth; see `errorTailBound` for how far above.
  kBall,
  /// The approximation of the WAFR 2016 planner: the vehicle's volume times the Gaussian density at the nearest point,
  /// which is first pulled towards the vehicle. No bound: see `collisionProbability` for where it is wrong.
  kGaussianVolume,
  /// Sum over the neighbours given of P(n.e >= d - r), n the unit vector to the neighbour: the half space that holds
  /// the sphere of radius r around it. Never below the truth for those neighbours; whatever is not among them counts
  /// nothing, however near.
  kHalfSpaces,
};

struct CollisionParameters {
  CollisionModel model = CollisionModel::kBall;
  double vehicle_radius_m = 0.4;

  double pull_to_vehicle_m = 0.8;            ///< kGaussianVolume: the nearest point comes this much nearer, 0 at most
  double measured_point_variance_m2 = 0.01;  ///< kGaussianVolume: each axis of a measured point's own error
};

/// Probability 0..1 that a spherical vehicle at the uncertain point touches what was measured.
/// @param neighbours  the measured points nearest to the mean, with none nearer left out; empty: nothing was measured
/// @return  0 without neighbours; 1 with one within the radius (kBall, kHalfSpaces); 1, never safe, for what cannot be
///          judged: a number anywhere that is not finite, a variance that is negative beyond rounding (of any axis;
///          kHalfSpaces: towards a neighbour), a covariance without a density (kGaussianVolume)
/// @pre vehicle_radius_m, pull_to_vehicle_m and measured_point_variance_m2 are not negative
///
/// The covariance is symmetrised. kBall allows for the index's float arithmetic, 20 micrometres at 20 m.
///
/// Against Monte Carlo, for walls of points 0.2 m apart and drift of 0.35 m (vertically 0.2 m), at the distance where
/// kBall says 1e-3; how many times the truth:
///                        one point   wall   corner of four walls   inside a hole in a wall
///   kBall                       43     14                    4.6                        15
///   kHalfSpaces, k = 16        3.5     12                    4.9                       7.6
/// kHalfSpaces with too few neighbours is below the truth: floor at 1 m, known to 0.02 m, hides from k = 1 a wall at
/// 1.05 m that drift hits with more than 2 %.
///
/// kGaussianVolume is within 10 % of the truth for one lone point, an error wide against the vehicle and no pull.
/// It takes one point for all obstacles and the density for constant over the sphere, so otherwise (radius 0.4 m,
/// error the same in all directions, times the truth):
///   wall at 1.5 m, error 1 m                       0.13    without pull 0.05
///   touching a wall at 0.3 m, error 2 m            0.02    it says 0.002, hardly above a constraint of 0.001
///   wall at 1.4 m, error 0.3 m                      230    without pull 0.08
///   corner of four walls at 1.5 m, error 0.3 m      110    without pull 0.016
///   one point at 1 m, error 0.1 m                   3e9    it says 1
///
/// Source of kGaussianVolume: Florence, Carter, Tedrake, WAFR 2016, and the authors' public planner. The pull is
/// towards x_C's mean, the vehicle at this sample.
///
/// Allocates: no. Threads: a function of its arguments.
[[nodiscard]] double collisionProbability(const UncertainPoint& x_C, std::span<const Neighbour> neighbours,
                                          const CollisionParameters& parameters);

/// How far from the mean a measured point can be and still matter: farther ones add less than 1e-9 to
/// collisionProbability, which may count as 0. Infinite for kGaussianVolume, which bounds nothing.
/// @param largest_variance_m2  of the error in any direction, or more
[[nodiscard]] double reachThatMatters_m(double largest_variance_m2, const CollisionParameters& parameters);

/// Upper bound of P(|e| > radius_m) for e ~ N(0, covariance_m2), never below the truth; less than 1e-300 counts as 0.
///
/// With the eigenvalues l1 >= l2 >= l3, conditioning on the third axis integrates in closed form when the other two are
/// equal; the general case is the average of that over the direction in the plane of the first two. The average is
/// taken from above, over four arcs of the quadrant each with its largest variance. So it is exact when l1 = l2: drift
/// that is the same in all horizontal directions and smaller vertically, discs, spheres.
///
/// Bound / exact tail (by quadrature; largest over radii and rotations):
///   standard deviations       at 1e-3   down to 1e-12
///   1, 1, anything up to 1   1.000001        1.000003
///   1, 0.9, 0.5                  1.18            1.48
///   1, 0.5, 0.5 or 0.25          1.51            2.05
///   needle or line               1.57            2.30
/// Slack for rounding: the eigenvalues are raised by 1e-7 of the largest, the result by 1e-12.
///
/// @return  1 for a radius that is not positive, and for a covariance or radius that is not valid
/// Allocates: no. Threads: a function of its arguments.
[[nodiscard]] double errorTailBound(const Mat3& covariance_m2, double radius_m);

}  // namespace nanomap
