#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "core/pose_buffer.h"
#include "core/pose_jobs.h"

namespace nanomap {

/// One corrected pose of a sliding-window estimator.
struct CorrectedPose {
  Time stamp{};
  Pose T_W_B;
};

/// A time-ordered sequence of corrected world poses: the window.
struct Correction {
  std::uint32_t epoch = 0;  ///< of the world the corrected poses are given in
  std::uint64_t sequence = 0;
  std::vector<CorrectedPose> poses;
};

enum class CorrectionVerdict : std::uint8_t {
  kAccepted,
  kEmpty,
  kNotOrdered,  ///< stamps do not increase
  kNotFinite,
  kNotUnit,
  kStaleEpoch,  ///< an older world than the pose stream's
  kOutOfOrder,  ///< its sequence number is not above the last accepted one's
  kNoOverlap,   ///< no original pose is held for any of its stamps
};
inline constexpr std::size_t kCorrectionVerdictCount = 8;

[[nodiscard]] std::string_view toString(CorrectionVerdict verdict);

/// kAccepted if the window is well formed by itself, else what is wrong with it.
[[nodiscard]] CorrectionVerdict checkCorrection(const Correction& correction);

/// A correction as a field of deltas over time: `T_Wnew_Wold(t)`, such that the corrected pose is the delta times the
/// original. Deltas, not poses, are interpolated, so that a sparse window (2 Hz) keeps the motion between its stamps.
/// Behind the window's end the last delta is carried on: a correction is always late.
/// Threads: one; any number of readers while it is not assigned.
class CorrectionField {
 public:
  /// Corrects nothing.
  CorrectionField() = default;

  /// Pairs each corrected pose with the original one at its stamp; those without an original are left out.
  /// @pre checkCorrection() accepted it
  CorrectionField(const Correction& correction, const PoseBuffer& originals) { assign(correction, originals); }

  /// The same, in place of what there was. Allocates for more corrected poses than ever before.
  void assign(const Correction& correction, const PoseBuffer& originals);

  enum class Coverage : std::uint8_t {
    kNone,     ///< before the window, or of a world that the window does not reach
    kInside,   ///< interpolated inside the window
    kCarried,  ///< newer than the window: the last delta
  };
  /// The deltas around a stamp. Borrows them.
  struct Delta {
    Coverage coverage = Coverage::kNone;
    const Pose* from = nullptr;  ///< valid if covered
    const Pose* to = nullptr;    ///< valid if covered, and `from` at its own stamp
    double weight = 1.0;         ///< of `to`

    /// @pre covered
    [[nodiscard]] Pose T_Wnew_Wold() const { return from == to ? *to : interpolate(*from, *to, weight); }
  };

  /// What to put before an original pose of that epoch, the body's or a camera's.
  [[nodiscard]] Delta deltaAt(Time stamp, std::uint32_t epoch) const;

  /// deltaAt() for one stamp after another, in time that is linear in the corrected poses passed over.
  class Walk {
   public:
    /// Borrows the field, which stays as it is.
    explicit Walk(const CorrectionField& field) : field_(field) {}

    /// @pre `stamp` is not before the one asked for last
    [[nodiscard]] Delta deltaAt(Time stamp, std::uint32_t epoch);

   private:
    const CorrectionField& field_;
    std::size_t after_ = 0;  ///< the first anchor that is not before the stamp asked for last
  };

  [[nodiscard]] bool empty() const { return anchors_.empty(); }
  [[nodiscard]] std::size_t anchorCount() const { return anchors_.size(); }

 private:
  struct Anchor {
    Time stamp{};
    std::uint32_t epoch = 0;  ///< of the original pose
    Pose T_Wnew_Wold;
  };

  /// @param after  the first anchor that is not before `stamp`
  [[nodiscard]] Delta deltaBefore(std::size_t after, Time stamp, std::uint32_t epoch) const;

  std::uint32_t epoch_ = 0;
  std::vector<Anchor> anchors_;
  std::vector<PoseJob> jobs_;  ///< room for assign()
};

}  // namespace nanomap
