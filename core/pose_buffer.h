#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/geometry.h"
#include "core/ring_buffer.h"
#include "core/time.h"

namespace nanomap {

/// How uncertain one step of the estimator was: an increment, never a marginal (absolute) covariance.
struct DriftIncrement {
  Mat3 covariance_W_m2 = Mat3::Zero();  ///< translation, in W
  Duration interval{};                  ///< the time the increment spans, ending at the pose's stamp; positive
};

/// One pose of the estimator's stream.
struct BodyPose {
  Time stamp{};
  Pose T_W_B;
  std::uint32_t epoch = 0;     ///< raised when the estimator's world jumps; poses of two epochs are never subtracted
  std::uint64_t sequence = 0;  ///< the estimator's own count
  std::optional<DriftIncrement> increment;
};

enum class PoseVerdict : std::uint8_t {
  kAccepted,
  kDuplicate,   ///< same stamp, same pose: re-sent
  kConflict,    ///< same stamp, another pose: the first stays
  kTooOld,      ///< before everything that a full buffer still holds
  kNotFinite,   ///< NaN or infinity in position or orientation
  kNotUnit,     ///< the orientation is not a unit quaternion (norm off by more than 0.001)
  kStaleEpoch,  ///< its epoch and stamp contradict the poses around it
};
inline constexpr std::size_t kPoseVerdictCount = 7;

[[nodiscard]] std::string_view toString(PoseVerdict verdict);

/// Is `pose` finite with a unit quaternion?
[[nodiscard]] inline bool isUsable(const Pose& pose) {
  // The norm's bounds, squared: without the root. What is not finite is not within them.
  constexpr double kTolerance = kUnitNormTolerance;
  const bool unit = std::abs(pose.rotation.squaredNorm() - (1.0 + kTolerance * kTolerance)) <= 2.0 * kTolerance;
  return unit && pose.translation_m.allFinite();
}

/// kAccepted if `pose` is finite with a unit quaternion, else what is wrong with it.
[[nodiscard]] PoseVerdict checkPose(const Pose& pose);

/// Time-ordered poses, bounded. Late and out-of-order poses are sorted in; when full, the oldest goes.
/// Allocates at construction only. Threads: one.
class PoseBuffer {
 public:
  /// @param capacity  poses held
  /// @param max_gap   widest gap between neighbouring poses that is interpolated across
  PoseBuffer(std::size_t capacity, Duration max_gap);

  [[nodiscard]] PoseVerdict insert(BodyPose pose);

  enum class LookupStatus : std::uint8_t {
    kFound,
    kBeforeOldest,   ///< no pose is that old (any more)
    kAfterNewest,    ///< not yet
    kBetweenEpochs,  ///< the estimator's world jumped between the neighbours
    kGap,            ///< the neighbours are farther apart than `max_gap`
  };
  struct Lookup {
    LookupStatus status = LookupStatus::kBeforeOldest;
    Pose T_W_B;               ///< valid if found
    std::uint32_t epoch = 0;  ///< valid if found
  };

  /// The poses around a stamp. Borrows them.
  struct Bracket {
    LookupStatus status = LookupStatus::kBeforeOldest;
    const BodyPose* from = nullptr;  ///< of one epoch with `to`, and the same pose at its own stamp; valid if found
    const BodyPose* to = nullptr;    ///< valid if found
    double weight = 1.0;             ///< of `to`

    /// Linear in translation, slerp in rotation. @pre found
    [[nodiscard]] Pose T_W_B() const {
      return from == to ? to->T_W_B : nanomap::interpolate(from->T_W_B, to->T_W_B, weight);
    }
  };

  /// Looks up one stamp after another, in time that is linear in the poses passed over.
  class Walk {
   public:
    /// Borrows the buffer, which stays as it is.
    explicit Walk(const PoseBuffer& poses) : poses_(poses) {}

    /// @pre `stamp` is not before the one asked for last
    [[nodiscard]] Bracket to(Time stamp);

   private:
    const PoseBuffer& poses_;
    std::optional<std::size_t> after_;  ///< lower bound of the stamp asked for last
  };

  /// Pose at `stamp`.
  [[nodiscard]] Lookup interpolate(Time stamp) const;

  /// Sum of the stream's increment covariances [m^2, W] over `from .. to`, in proportion where an interval is cut.
  /// A lost message's share is taken at the rate of the next one. Empty if a pose in the span carries no increment.
  [[nodiscard]] std::optional<Mat3> accumulatedCovariance(Time from, Time to) const;

  [[nodiscard]] bool empty() const { return poses_.empty(); }
  [[nodiscard]] const BodyPose& newest() const { return poses_.back(); }
  [[nodiscard]] const BodyPose& oldest() const { return poses_.front(); }
  [[nodiscard]] std::size_t size() const { return poses_.size(); }

 private:
  /// Index of the first pose with a stamp not before `stamp`.
  [[nodiscard]] std::size_t lowerBound(Time stamp) const;
  /// @param after  lowerBound(stamp)
  [[nodiscard]] Bracket bracketBefore(std::size_t after, Time stamp) const;

  RingBuffer<BodyPose> poses_;
  Duration max_gap_;
};

}  // namespace nanomap
