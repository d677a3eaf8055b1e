#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "core/pose_buffer.h"
#include "core/ring_buffer.h"
#include "core/time.h"
#include "drivers/mavlink/alignment_fit.h"
#include "drivers/mavlink/autopilot_state.h"
#include "drivers/mavlink/ned_from_world.h"

namespace nanomap {

struct AlignmentParameters {
  Duration window = std::chrono::seconds(10);              ///< for the heading, and whether the streams fit
  Duration place_window = std::chrono::milliseconds(500);  ///< for the place: drift is followed, noise is not
  Duration min_spacing = std::chrono::milliseconds(50);    ///< between the pairs of the window
  std::size_t min_pairs = 20;                              ///< fewer say nothing
  /// Of the newest pair. An estimator that is reset in silence moves what we send unseen, so this is no longer than a
  /// fault takes to become critical; and 25 times the interval that poses are asked for at, so that a link may lose
  /// half of them and pause for 0.3 s.
  Duration max_age = std::chrono::milliseconds(500);

  double max_position_residual_m = 0.5;    ///< median over the window: more is inconsistent
  double max_heading_residual_rad = 0.17;  ///< the same; 10 degrees, a poor compass

  double jump_m = 1.0;         ///< a pair that is off by more has jumped, or is an outlier
  double jump_rad = 0.35;      ///< the same; 20 degrees
  std::size_t jump_pairs = 5;  ///< as many in a row are no outliers
  double follow_m_s = 0.2;     ///< how fast setpoints may be shifted, at the vehicle
  double follow_rad_s = 0.05;  ///< and turned
  AlignmentWeights weights{};
};

enum class AlignmentVerdict : std::uint8_t {
  kUnknown,  ///< too few pairs, or none of late
  kGood,
  kInconsistent,  ///< the two streams do not tell of the same motion, or one has just jumped, or keeps jumping
};
[[nodiscard]] std::string_view toString(AlignmentVerdict verdict);

/// T_NED_W as it is known.
struct Alignment {
  AlignmentVerdict verdict = AlignmentVerdict::kUnknown;
  std::optional<NedFromWorld> T_NED_W;  ///< empty before the first minimum of pairs, and after a new epoch
  /// How far the window's pairs are off what explains them best, in the median, or T_NED_W is off that: the larger.
  double position_residual_m = 0.0;
  double heading_residual_rad = 0.0;
  std::size_t pairs = 0;
  std::uint32_t epoch = 0;  ///< of W
  std::uint64_t jumps = 0;  ///< that no epoch explains; each starts the window anew
};

struct AlignmentCounters {
  std::uint64_t pairs = 0;
  std::uint64_t outliers = 0;    ///< pairs that were off by themselves
  std::uint64_t unmatched = 0;   ///< autopilot poses without a pose of the VIO at their time
  std::uint64_t disordered = 0;  ///< autopilot poses that were not newer than the one before, or not finite
  std::uint64_t dropped = 0;     ///< autopilot poses that waited for the VIO for too long
};

/// Estimates T_NED_W from both estimators' poses over a sliding window: heading from both attitudes and, the more the
/// vehicle has moved, from both tracks; the place from the newest poses only, because one of the worlds drifts. What it
/// gives follows that answer slowly, so that setpoints are not stepped; after a jump of either estimator it starts anew
/// from the poses since, and says so.
/// Pure: time comes with the data. Allocates at construction, and scratch memory for each pair. Threads: one.
class AlignmentEstimator {
 public:
  /// @throws std::invalid_argument naming the parameter
  explicit AlignmentEstimator(const AlignmentParameters& parameters);

  void addWorldPose(const BodyPose& pose);
  void addAutopilotPose(const AutopilotPose& pose);

  [[nodiscard]] Alignment alignment(Time now) const;
  [[nodiscard]] const AlignmentCounters& counters() const { return counters_; }

 private:
  void pairWaiting();
  void addPair(const AlignmentPair& pair, std::uint32_t epoch);
  [[nodiscard]] bool jumpedWith(const AlignmentPair& pair);
  void keep(const AlignmentPair& pair);
  void startAnew(std::uint32_t epoch);
  void follow(Duration elapsed);

  AlignmentParameters parameters_;
  PoseBuffer world_poses_;
  RingBuffer<AutopilotPose> waiting_;  ///< for the VIO's poses around them
  std::optional<Time> newest_autopilot_;

  RingBuffer<AlignmentPair> window_;  ///< all of one epoch, oldest first
  RingBuffer<AlignmentPair> suspects_;
  std::uint32_t epoch_ = 0;
  bool after_jump_ = false;  ///< until the window has its minimum again
  std::uint64_t jumps_ = 0;
  std::optional<Time> last_jump_;
  Time unsettled_until_{};               ///< jumps that follow each other are no jumps: the streams do not fit
  std::optional<NedFromWorld> fit_;      ///< of the window, placed by its newest
  std::optional<NedFromWorld> T_NED_W_;  ///< given out
  AlignmentResiduals residuals_;         ///< as in Alignment
  AlignmentCounters counters_;
};

}  // namespace nanomap
