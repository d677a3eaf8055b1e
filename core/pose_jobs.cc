#include "core/pose_jobs.h"

#include <algorithm>
#include <array>
#include <cstddef>

#include "core/simd.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "core/pose_jobs.cc"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "core/pose_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace nanomap::HWY_NAMESPACE {

/// Reads a vector of jobs, calls compose(interpolated, poses), and writes what it returns; until all are done.
template <class Compose>
HWY_INLINE void doJobs(std::span<const PoseJob> jobs, Compose&& compose) {
  std::array<const Pose*, kPoseLanes> from;
  std::array<const Pose*, kPoseLanes> to;
  std::array<const Pose*, kPoseLanes> pose;
  std::array<Pose*, kPoseLanes> result;
  HWY_ALIGN std::array<double, kPoseLanes> weight;
  for (std::size_t first = 0; first < jobs.size(); first += kPoseLanes) {
    for (std::size_t lane = 0; lane < kPoseLanes; ++lane) {
      // Lanes behind the last job do it as well.
      const PoseJob& job = jobs[std::min(first + lane, jobs.size() - 1)];
      from[lane] = job.from;
      to[lane] = job.to;
      pose[lane] = job.pose;
      result[lane] = job.result;
      weight[lane] = job.weight_of_to;
    }
    const Poses interpolated = interpolate(load(from), load(to), hn::Load(PoseTag(), weight.data()));
    store(compose(interpolated, load(pose)), result);
  }
}

void makeDeltas(std::span<const PoseJob> jobs) {
  doJobs(jobs, [](const Poses& T_Wold_B, const Poses& T_Wnew_B) HWY_ATTR {
    const Rotations R_Wnew_Wold = normalized(T_Wnew_B.rotation) * conjugate(T_Wold_B.rotation);
    return Poses{R_Wnew_Wold, T_Wnew_B.translation_m - rotate(R_Wnew_Wold, T_Wold_B.translation_m)};
  });
}

void applyDeltas(std::span<const PoseJob> jobs) {
  doJobs(jobs, [](const Poses& T_Wnew_Wold, const Poses& T_Wold_S) HWY_ATTR {
    return Poses{unitAgain(T_Wnew_Wold.rotation * T_Wold_S.rotation),
                 rotate(T_Wnew_Wold.rotation, T_Wold_S.translation_m) + T_Wnew_Wold.translation_m};
  });
}

}  // namespace nanomap::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace nanomap {

HWY_EXPORT(makeDeltas);
HWY_EXPORT(applyDeltas);

void makeDeltas(std::span<const PoseJob> jobs) { HWY_DYNAMIC_DISPATCH(makeDeltas)(jobs); }
void applyDeltas(std::span<const PoseJob> jobs) { HWY_DYNAMIC_DISPATCH(applyDeltas)(jobs); }

}  // namespace nanomap
#endif  // HWY_ONCE
