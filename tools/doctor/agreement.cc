#include "tools/doctor/agreement.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nanomap::doctor {
namespace {

constexpr int kStep_px = 4;                ///< between the points tried, along columns and rows
constexpr double kLeastInView = 0.25;      ///< of a pair's points
constexpr double kNearest_m = 0.05;        ///< what is carried to nearer than this has left the view
constexpr double kTolerance_m = 0.08;      ///< of a depth: noise and a pixel's own slope,
constexpr double kTolerance_per_m = 0.03;  ///< and what grows with it

struct Tally {
  double points = 0.0;
  double judged = 0.0;
  double agreed = 0.0;
};

Tally tallyOf(const FramePair& pair, const CameraModel& camera, const Trial& trial) {
  const Pose T_to_from = relativePose(pair.T_W_B_to * trial.T_B_C, pair.T_W_B_from * trial.T_B_C);
  Tally tally;
  for (int v = kStep_px / 2; v < camera.height(); v += kStep_px) {
    for (int u = kStep_px / 2; u < camera.width(); u += kStep_px) {
      const auto pixel = static_cast<std::size_t>(v * camera.width() + u);
      const std::uint16_t raw = pair.from->pixels[pixel];
      if (camera.classify(raw) != DepthReading::kInRange) continue;
      ++tally.points;
      const Vec3 p_to = T_to_from * Vec3(trial.depth_factor * camera.deproject(pixel, raw).cast<double>());
      if (p_to.z() < kNearest_m * trial.depth_factor) continue;
      const auto seen_at = camera.pixelAt(p_to.x() / p_to.z(), p_to.y() / p_to.z());
      if (!seen_at) continue;
      const std::uint16_t seen = pair.to->pixels[static_cast<std::size_t>(seen_at->v * camera.width() + seen_at->u)];
      if (camera.classify(seen) != DepthReading::kInRange) continue;
      ++tally.judged;
      // In the camera's own metres, so that no factor gains by a wider tolerance.
      const double carried_m = p_to.z() / trial.depth_factor;
      const auto seen_m = static_cast<double>(camera.depth(seen));
      if (std::abs(carried_m - seen_m) <= kTolerance_m + kTolerance_per_m * seen_m) ++tally.agreed;
    }
  }
  return tally;
}

}  // namespace

std::optional<double> agreement(const std::vector<FramePair>& pairs, const CameraModel& camera, const Trial& trial) {
  double judged = 0.0;
  double agreed = 0.0;
  for (const FramePair& pair : pairs) {
    const Tally tally = tallyOf(pair, camera, trial);
    judged += std::max(tally.judged, kLeastInView * tally.points);
    agreed += tally.agreed;
  }
  if (judged == 0.0) return std::nullopt;
  return agreed / judged;
}

}  // namespace nanomap::doctor
