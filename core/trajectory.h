#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/geometry.h"
#include "core/time.h"

namespace nanomap {

/// Where a point is and how it moves, all three in the frame that the owner names.
struct Motion {
  Vec3 position_m = Vec3::Zero();
  Vec3 velocity_m_s = Vec3::Zero();
  Vec3 acceleration_m_s2 = Vec3::Zero();
};

/// The motion `duration_s` later, at constant jerk [m/s^3] in the motion's frame.
[[nodiscard]] Motion advance(const Motion& motion, const Vec3& jerk_m_s3, double duration_s);

/// A motion with constant jerk in each of a few pieces, in W. A value: no allocation anywhere.
class Trajectory {
 public:
  /// Two pieces of a primitive's beginning and five of a brake, and one to spare.
  static constexpr std::size_t kMaxPieces = 8;

  struct Piece {
    double duration_s = 0.0;
    Vec3 jerk_W_m_s3 = Vec3::Zero();
  };

  Trajectory() = default;
  Trajectory(Time start, const Motion& at_start_W) : start_(start), at_start_W_(at_start_W) {}

  /// A piece of no length is left out. @pre duration_s >= 0, pieces().size() < kMaxPieces unless it is 0
  void append(double duration_s, const Vec3& jerk_W_m_s3);

  [[nodiscard]] Time start() const { return start_; }
  [[nodiscard]] const Motion& atStart() const { return at_start_W_; }
  [[nodiscard]] std::span<const Piece> pieces() const { return {pieces_.data(), piece_count_}; }
  [[nodiscard]] double duration_s() const;

  /// The motion in W, `elapsed_s` after the start, in closed form. Before the start it is that at the start, after the
  /// end that at the end: one that ends at rest goes on standing still.
  [[nodiscard]] Motion sample(double elapsed_s) const;
  [[nodiscard]] Motion sample(Time time) const { return sample(toSeconds(time - start_)); }
  [[nodiscard]] Motion atEnd() const { return sample(duration_s()); }

  /// The same motion, ended `duration_s` after the start if it lasts longer.
  [[nodiscard]] Trajectory firstPart(double duration_s) const;

  /// The same motion from `time` on. @pre time >= start()
  [[nodiscard]] Trajectory rest(Time time) const;

 private:
  Time start_{};
  Motion at_start_W_;
  std::size_t piece_count_ = 0;
  std::array<Piece, kMaxPieces> pieces_{};
};

/// A trajectory to be sampled often: keeps where each of its pieces begins. Borrows the trajectory.
class TrajectorySampler {
 public:
  explicit TrajectorySampler(const Trajectory& trajectory);

  [[nodiscard]] double duration_s() const { return duration_s_; }

  /// The trajectory's sample(), to the last bit.
  [[nodiscard]] Motion at(double elapsed_s) const;

 private:
  std::span<const Trajectory::Piece> pieces_;
  double duration_s_;
  std::array<Motion, Trajectory::kMaxPieces + 1> begins_;  ///< of the pieces, and what follows the last
};

}  // namespace nanomap
