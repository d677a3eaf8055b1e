#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/correction.h"
#include "core/drift.h"
#include "core/pose_buffer.h"
#include "core/snapshot.h"
#include "core/view.h"

namespace nanomap {

struct ChainParameters {
  std::size_t history_views = 150;  ///< N of the paper
  std::size_t waiting_views = 16;   ///< views whose pose cannot be interpolated yet
  std::size_t pose_capacity = 4096;
  Duration max_pose_gap = std::chrono::milliseconds(100);
  Duration max_lead = std::chrono::milliseconds(500);  ///< a view farther ahead of the newest pose is from the future
  DriftModel drift{};
};

/// Why a view never entered the chain.
enum class ViewDrop : std::uint8_t {
  kDuplicate,      ///< a view with that stamp is held
  kLate,           ///< older than the newest view of the chain
  kNoPose,         ///< older than every pose held
  kBetweenEpochs,  ///< taken while the estimator's world jumped
  kPoseGap,        ///< the poses around it are too far apart
  kFromFuture,     ///< too far ahead of the newest pose: another clock
  kWaitingFull,    ///< the oldest that waited made room for a new one
};
inline constexpr std::size_t kViewDropCount = 7;

[[nodiscard]] std::string_view toString(ViewDrop drop);

/// Everything that went in, by what became of it.
struct ChainCounters {
  std::array<std::uint64_t, kPoseVerdictCount> poses{};
  std::array<std::uint64_t, kCorrectionVerdictCount> corrections{};
  std::array<std::uint64_t, kViewDropCount> views_dropped{};
  std::uint64_t views_inserted = 0;
  std::uint64_t views_retired = 0;               ///< pushed out of a full history
  std::uint64_t edges_corrected = 0;             ///< edges that corrections changed
  std::uint64_t correction_poses_unmatched = 0;  ///< corrected poses without an original, left out
  std::uint64_t increments_missing = 0;          ///< edges that wanted increment covariances and fell back to the law

  [[nodiscard]] std::uint64_t posesAccepted() const { return poses[static_cast<std::size_t>(PoseVerdict::kAccepted)]; }
  [[nodiscard]] std::uint64_t viewsDropped() const;
};

/// An edge of the chain, as it stands.
struct Edge {
  Pose T_older_newer;                       ///< T_{C_i}_{C_{i-1}}; for the first edge T_{C_0}_B
  Mat3 covariance_older_m2 = Mat3::Zero();  ///< translational, in the frame of the older end
};

/// NanoMap's data structure (paper IV.B): newest-first pairs of (edge, view), with views that wait for their pose.
/// Edges are primary; nothing here has one world frame. Insertion and removal of a view are O(1), a correction is
/// linear in the views and corrected poses.
/// Threads: one (stage T3). Readers get snapshots. Allocates at construction, and for corrections with more poses than
/// ever before.
class Chain {
 public:
  /// @throws std::invalid_argument naming the parameter
  explicit Chain(const ChainParameters& parameters);

  struct PoseOutcome {
    PoseVerdict verdict = PoseVerdict::kAccepted;
    std::size_t views_inserted = 0;  ///< views that had waited for it
  };
  /// Refreshes edge 0 and lets waiting views in.
  PoseOutcome addPose(const BodyPose& pose);

  struct ViewOutcome {
    bool waiting = false;  ///< its pose cannot be interpolated yet
    std::optional<ViewDrop> drop;
  };
  /// Inserts the view, lets it wait, or drops it. `waiting` false and no `drop` means it is in the chain.
  ViewOutcome addView(ViewPtr view);

  /// Corrects the relative transforms inside the window (DESIGN.md "Correction").
  CorrectionVerdict addCorrection(const Correction& correction);

  /// Writes the chain's present state to `out`, reusing its storage. Before any pose the snapshot is empty; views
  /// behind an edge that a jump of the estimator's world has cut are left out until a correction joins them again.
  void snapshotInto(ChainSnapshot& out) const;
  [[nodiscard]] ChainSnapshot snapshot() const;

  /// Edges newest first, edge 0 being T_{C_0}_B, up to the first one that is cut.
  [[nodiscard]] std::vector<Edge> edges() const;

  /// Of the newest view; empty without one.
  [[nodiscard]] std::optional<Time> newestViewStamp() const;

  [[nodiscard]] std::size_t viewCount() const { return links_.size(); }
  [[nodiscard]] std::size_t waitingCount() const { return waiting_.size(); }
  [[nodiscard]] const PoseBuffer& poses() const { return poses_; }
  [[nodiscard]] const ChainCounters& counters() const { return counters_; }

 private:
  /// What is at one end of an edge, the body or a view's camera: its original pose, and where the last correction that
  /// reached it puts it.
  struct Station {
    Time stamp{};
    std::uint32_t epoch = 0;  ///< of the original
    Pose T_W_S_original;
    CorrectionField::Coverage coverage = CorrectionField::Coverage::kNone;
    std::uint64_t correction_serial = 0;  ///< of that correction, 0 without one
    std::uint32_t world_epoch = 0;        ///< of the pose below
    Pose T_W_S;                           ///< corrected, or the original without a correction
  };
  struct Link {
    ViewPtr view;
    Station station;                   ///< of the view's camera
    std::optional<Pose> T_this_newer;  ///< to the next newer view's camera; empty if cut by a jump, or if newest
    std::optional<Mat3> increment_covariance_W_m2;  ///< of that edge, from the messages
  };

  ViewOutcome admit(const ViewPtr& view);
  std::size_t admitWaiting();
  ViewOutcome drop(ViewDrop reason);

  [[nodiscard]] CorrectionVerdict tryCorrection(const Correction& correction);
  /// Remembers that the last correction moves `station`; its corrected pose is still to be made.
  void cover(Station& station, CorrectionField::Coverage coverage) const;
  void correctEdge(Link& older, const Link& newer);

  [[nodiscard]] Station stationAt(Time stamp, const Pose& T_W_S_original, std::uint32_t epoch) const;
  [[nodiscard]] std::optional<Mat3> incrementBetween(Time older, Time newer) const;
  /// T_older_newer, or empty if the world jumped between the two and no correction tells how.
  [[nodiscard]] static std::optional<Pose> edgeBetween(const Station& older, const Station& newer);
  template <class Visitor>
  void walkEdges(Visitor&& visit) const;

  struct CorrectionId {
    std::uint32_t epoch = 0;
    std::uint64_t sequence = 0;
  };

  ChainParameters parameters_;
  PoseBuffer poses_;
  RingBuffer<Link> links_;       ///< newest at the front
  RingBuffer<ViewPtr> waiting_;  ///< oldest at the front
  CorrectionField correction_;
  CorrectionField next_correction_;      ///< room for the one that comes in
  std::vector<PoseJob> jobs_;            ///< room for a correction
  std::uint64_t correction_serial_ = 0;  ///< counts the accepted corrections
  std::optional<CorrectionId> last_correction_;
  ChainCounters counters_;
};

}  // namespace nanomap
