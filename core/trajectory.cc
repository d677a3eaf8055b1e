#include "core/trajectory.h"

#include <algorithm>
#include <cassert>

namespace nanomap {

Motion advance(const Motion& motion, const Vec3& jerk_m_s3, double duration_s) {
  const double t_s = duration_s;
  const Vec3& a = motion.acceleration_m_s2;
  return {motion.position_m + t_s * (motion.velocity_m_s + t_s * (a / 2.0 + t_s * jerk_m_s3 / 6.0)),
          motion.velocity_m_s + t_s * (a + t_s * jerk_m_s3 / 2.0), a + t_s * jerk_m_s3};
}

void Trajectory::append(double duration_s, const Vec3& jerk_W_m_s3) {
  assert(duration_s >= 0.0);
  if (duration_s == 0.0) return;
  assert(piece_count_ < kMaxPieces);
  pieces_[piece_count_++] = {duration_s, jerk_W_m_s3};
}

double Trajectory::duration_s() const {
  double duration_s = 0.0;
  for (const Piece& piece : pieces()) duration_s += piece.duration_s;
  return duration_s;
}

Motion Trajectory::sample(double elapsed_s) const {
  Motion motion = at_start_W_;
  double left_s = std::max(elapsed_s, 0.0);
  for (const Piece& piece : pieces()) {
    motion = advance(motion, piece.jerk_W_m_s3, std::min(left_s, piece.duration_s));
    if (left_s <= piece.duration_s) break;
    left_s -= piece.duration_s;
  }
  return motion;
}

Trajectory Trajectory::firstPart(double duration_s) const {
  Trajectory part(start_, at_start_W_);
  double left_s = std::max(duration_s, 0.0);
  for (const Piece& piece : pieces()) {
    part.append(std::min(left_s, piece.duration_s), piece.jerk_W_m_s3);
    if (left_s <= piece.duration_s) break;
    left_s -= piece.duration_s;
  }
  return part;
}

Trajectory Trajectory::rest(Time time) const {
  assert(time >= start_);
  Trajectory rest(time, sample(time));
  double passed_s = toSeconds(time - start_);
  for (const Piece& piece : pieces()) {
    rest.append(std::max(piece.duration_s - passed_s, 0.0), piece.jerk_W_m_s3);
    passed_s = std::max(passed_s - piece.duration_s, 0.0);
  }
  return rest;
}

TrajectorySampler::TrajectorySampler(const Trajectory& trajectory)
    : pieces_(trajectory.pieces()), duration_s_(trajectory.duration_s()) {
  begins_[0] = trajectory.atStart();
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    begins_[i + 1] = advance(begins_[i], pieces_[i].jerk_W_m_s3, pieces_[i].duration_s);
  }
}

Motion TrajectorySampler::at(double elapsed_s) const {
  double left_s = std::max(elapsed_s, 0.0);
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const Trajectory::Piece& piece = pieces_[i];
    if (left_s <= piece.duration_s) return advance(begins_[i], piece.jerk_W_m_s3, left_s);
    left_s -= piece.duration_s;
  }
  return begins_[pieces_.size()];
}

}  // namespace nanomap
