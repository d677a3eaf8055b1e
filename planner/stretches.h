#pragma once

#include <algorithm>
#include <cmath>

#include "core/trajectory.h"

namespace nanomap {

/// Where a trajectory is sampled: at the ends of a few stretches of equal time, and in even steps along each of them,
/// so that no two samples are much farther apart than need be. Borrows the trajectory.
class Stretches {
 public:
  /// @param samples  steps of the whole trajectory, at least
  Stretches(const Trajectory& trajectory, int samples)
      : sampler_(trajectory), count_(std::min(samples, kMost)), least_steps_((samples + count_ - 1) / count_) {}

  [[nodiscard]] int count() const { return count_; }

  /// When the first `stretches` have passed.
  [[nodiscard]] double end_s(int stretches) const {
    return sampler_.duration_s() * (static_cast<double>(stretches) / count_);
  }

  [[nodiscard]] Motion at(double elapsed_s) const { return sampler_.at(elapsed_s); }

  /// Calls `visit(motion_W, elapsed_s)` for all samples but the start, in turn, until one says false. Steps of a
  /// stretch are as many as the speeds at its ends tell; where one is longer than `longest_m` all the same, it is
  /// parted.
  /// @return  did it never say false?
  template <class Visitor>
  bool visit(double longest_m, Visitor&& visit) const {
    Motion begin_W = at(0.0);
    Vec3 last_W_m = begin_W.position_m;
    for (int i = 1; i <= count_; ++i) {
      const Motion end_W = at(end_s(i));
      const int steps = stepsOf(begin_W, end_W, longest_m);
      const auto timeAt = [&](double step) { return std::lerp(end_s(i - 1), end_s(i), step / steps); };
      for (int step = 1; step <= steps; ++step) {
        const Motion next_W = step == steps ? end_W : at(timeAt(step));
        const int parts = partsOf((next_W.position_m - last_W_m).norm(), longest_m);
        for (int part = 1; part < parts; ++part) {
          const double elapsed_s = timeAt(step - 1 + static_cast<double>(part) / parts);
          if (!visit(at(elapsed_s), elapsed_s)) return false;
        }
        if (!visit(next_W, timeAt(step))) return false;
        last_W_m = next_W.position_m;
      }
      begin_W = end_W;
    }
    return true;
  }

 private:
  static constexpr int kMost = 5;

  /// As many as leave none longer, at an even pace.
  [[nodiscard]] static int partsOf(double length_m, double longest_m) {
    return std::max(static_cast<int>(std::ceil(length_m / longest_m)), 1);
  }

  /// Of a stretch with such a beginning and end.
  [[nodiscard]] int stepsOf(const Motion& begin, const Motion& end, double longest_m) const {
    const double duration_s = sampler_.duration_s() / count_;
    const double greatest_speed_m_s = std::max(begin.velocity_m_s.norm(), end.velocity_m_s.norm());
    const double length_m = std::max((end.position_m - begin.position_m).norm(), greatest_speed_m_s * duration_s);
    return std::max(partsOf(length_m, longest_m), least_steps_);
  }

  TrajectorySampler sampler_;
  int count_;
  int least_steps_;
};

}  // namespace nanomap
