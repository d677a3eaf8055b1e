#include "core/chain.h"

#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace nanomap {
namespace {

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("chain: " + message);
}

ChainParameters checked(const ChainParameters& p) {
  require(p.history_views > 0, "history_views must be positive");
  require(p.waiting_views > 0, "waiting_views must be positive");
  require(p.pose_capacity > 1, "pose_capacity must be two or more");
  require(p.max_pose_gap > Duration::zero(), "max_pose_gap must be positive");
  require(p.max_lead >= Duration::zero(), "max_lead must not be negative");
  require(std::isfinite(p.drift.horizontal_std_m) && p.drift.horizontal_std_m >= 0.0 &&
              std::isfinite(p.drift.vertical_std_m) && p.drift.vertical_std_m >= 0.0,
          "the drift's standard deviations must be zero or more");
  require(p.drift.after > Duration::zero(), "the drift's time must be positive");
  return p;
}

/// A covariance given in W, seen from a camera.
Mat3 inCamera(const Pose& T_W_C, const Mat3& covariance_W_m2) {
  const Mat3 R_C_W = T_W_C.rotation.conjugate().toRotationMatrix();
  return R_C_W * covariance_W_m2 * R_C_W.transpose();
}

}  // namespace

std::string_view toString(ViewDrop drop) {
  switch (drop) {
    case ViewDrop::kDuplicate:
      return "duplicate";
    case ViewDrop::kLate:
      return "late";
    case ViewDrop::kNoPose:
      return "older than every pose";
    case ViewDrop::kBetweenEpochs:
      return "taken while the world jumped";
    case ViewDrop::kPoseGap:
      return "gap in the poses";
    case ViewDrop::kFromFuture:
      return "from the future";
    case ViewDrop::kWaitingFull:
      return "waited too long";
  }
  return "?";
}

std::uint64_t ChainCounters::viewsDropped() const {
  return std::accumulate(views_dropped.begin(), views_dropped.end(), std::uint64_t{0});
}

Chain::Chain(const ChainParameters& parameters)
    : parameters_(checked(parameters)),
      poses_(parameters.pose_capacity, parameters.max_pose_gap),
      links_(parameters.history_views),
      waiting_(parameters.waiting_views) {
  jobs_.reserve(parameters.history_views);
}

Chain::PoseOutcome Chain::addPose(const BodyPose& pose) {
  PoseOutcome outcome;
  outcome.verdict = poses_.insert(pose);
  ++counters_.poses[static_cast<std::size_t>(outcome.verdict)];
  if (outcome.verdict == PoseVerdict::kAccepted) outcome.views_inserted = admitWaiting();
  return outcome;
}

Chain::ViewOutcome Chain::addView(ViewPtr view) {
  const Time stamp = view->stamp();
  std::size_t at = waiting_.size();
  while (at > 0 && waiting_[at - 1]->stamp() > stamp) --at;
  const bool held_waiting = at > 0 && waiting_[at - 1]->stamp() == stamp;
  const bool held = !links_.empty() && links_.front().station.stamp == stamp;
  if (held || held_waiting) return drop(ViewDrop::kDuplicate);
  if (!poses_.empty() && stamp > poses_.newest().stamp + parameters_.max_lead) return drop(ViewDrop::kFromFuture);

  const ViewOutcome outcome = admit(view);
  if (!outcome.waiting) return outcome;
  if (waiting_.full()) {
    if (at == 0) return drop(ViewDrop::kWaitingFull);
    drop(ViewDrop::kWaitingFull);
    waiting_.popFront();
    --at;
  }
  waiting_.insert(at, std::move(view));
  return outcome;
}

void Chain::cover(Station& station, CorrectionField::Coverage coverage) const {
  station.coverage = coverage;
  station.correction_serial = correction_serial_;
  station.world_epoch = last_correction_->epoch;
}

CorrectionVerdict Chain::addCorrection(const Correction& correction) {
  const CorrectionVerdict verdict = tryCorrection(correction);
  ++counters_.corrections[static_cast<std::size_t>(verdict)];
  return verdict;
}

CorrectionVerdict Chain::tryCorrection(const Correction& correction) {
  if (const auto verdict = checkCorrection(correction); verdict != CorrectionVerdict::kAccepted) return verdict;
  if (!poses_.empty() && correction.epoch < poses_.newest().epoch) return CorrectionVerdict::kStaleEpoch;
  if (last_correction_) {
    if (correction.epoch < last_correction_->epoch) return CorrectionVerdict::kStaleEpoch;
    const bool same_world = correction.epoch == last_correction_->epoch;
    if (same_world && correction.sequence <= last_correction_->sequence) return CorrectionVerdict::kOutOfOrder;
  }
  next_correction_.assign(correction, poses_);
  if (next_correction_.empty()) return CorrectionVerdict::kNoOverlap;

  std::swap(correction_, next_correction_);
  counters_.correction_poses_unmatched += correction.poses.size() - correction_.anchorCount();
  last_correction_ = {correction.epoch, correction.sequence};
  ++correction_serial_;
  jobs_.clear();
  CorrectionField::Walk walk(correction_);
  for (std::size_t i = links_.size(); i-- > 0;) {
    Station& station = links_[i].station;
    const CorrectionField::Delta delta = walk.deltaAt(station.stamp, station.epoch);
    if (delta.coverage == CorrectionField::Coverage::kNone) continue;
    cover(station, delta.coverage);
    jobs_.push_back({delta.from, delta.weight, delta.to, &station.T_W_S_original, &station.T_W_S});
  }
  applyDeltas(jobs_);
  for (std::size_t i = 1; i < links_.size(); ++i) correctEdge(links_[i], links_[i - 1]);
  return CorrectionVerdict::kAccepted;
}

void Chain::correctEdge(Link& older, const Link& newer) {
  const auto inside = [this](const Station& station) {
    return station.coverage == CorrectionField::Coverage::kInside && station.correction_serial == correction_serial_;
  };
  if (inside(older.station) && inside(newer.station)) {
    older.T_this_newer = relativePose(older.station.T_W_S, newer.station.T_W_S);
  } else if (!older.T_this_newer) {
    older.T_this_newer = edgeBetween(older.station, newer.station);
  } else {
    return;
  }
  if (older.T_this_newer) ++counters_.edges_corrected;
}

void Chain::snapshotInto(ChainSnapshot& out) const {
  out.views.clear();
  if (poses_.empty()) {
    out = {};
    return;
  }
  const BodyPose& body = poses_.newest();
  out.stamp = body.stamp;
  out.T_W_B = body.T_W_B;
  out.epoch = body.epoch;
  out.pose_sequence = body.sequence;
  out.correction_sequence.reset();
  if (last_correction_) out.correction_sequence = last_correction_->sequence;

  const Vec3 up_B = body.T_W_B.rotation.conjugate() * Vec3::UnitZ();
  Pose T_C_B;
  Mat3 covariance_C_m2 = Mat3::Zero();
  walkEdges([&](const Link& link, const Edge& edge) {
    T_C_B = edge.T_older_newer * T_C_B;
    const Mat3 R_older_newer = edge.T_older_newer.rotation.toRotationMatrix();
    covariance_C_m2 = edge.covariance_older_m2 + R_older_newer * covariance_C_m2 * R_older_newer.transpose();
    const Mat3 R_C_B = T_C_B.rotation.toRotationMatrix();
    out.views.push_back({link.view, R_C_B, T_C_B.translation_m, covariance_C_m2, R_C_B * up_B});
  });
  out.filter.assign(out.views);
}

ChainSnapshot Chain::snapshot() const {
  ChainSnapshot out;
  snapshotInto(out);
  return out;
}

std::optional<Time> Chain::newestViewStamp() const {
  if (links_.empty()) return std::nullopt;
  return links_.front().station.stamp;
}

std::vector<Edge> Chain::edges() const {
  std::vector<Edge> edges;
  edges.reserve(links_.size());
  walkEdges([&](const Link&, const Edge& edge) { edges.push_back(edge); });
  return edges;
}

/// Calls `visit(link, edge to the next newer)` newest first, up to the first edge that is cut.
template <class Visitor>
void Chain::walkEdges(Visitor&& visit) const {
  if (links_.empty() || poses_.empty()) return;
  const BodyPose& body = poses_.newest();
  const Time now = body.stamp;
  Time newer_stamp = now;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    Edge edge;
    std::optional<Mat3> increment_W_m2 = link.increment_covariance_W_m2;
    if (i == 0) {
      const auto T_C_B = edgeBetween(link.station, stationAt(body.stamp, body.T_W_B, body.epoch));
      if (!T_C_B) return;
      edge.T_older_newer = *T_C_B;
      increment_W_m2 = incrementBetween(link.station.stamp, now);
    } else {
      if (!link.T_this_newer) return;
      edge.T_older_newer = *link.T_this_newer;
    }
    // The law gives the variance at an age. An edge holds what its share of time adds to it, seen from now.
    const DriftModel& drift = parameters_.drift;
    const Mat3 covariance_W_m2 =
        increment_W_m2
            ? *increment_W_m2
            : Mat3((drift.variance_W(now - link.station.stamp) - drift.variance_W(now - newer_stamp)).asDiagonal());
    edge.covariance_older_m2 = inCamera(link.station.T_W_S_original, covariance_W_m2);
    visit(link, edge);
    newer_stamp = link.station.stamp;
  }
}

/// The drift that the messages report between two stamps, if it is wanted and known.
std::optional<Mat3> Chain::incrementBetween(Time older, Time newer) const {
  if (!parameters_.drift.use_increments) return std::nullopt;
  return poses_.accumulatedCovariance(older, newer);
}

Chain::Station Chain::stationAt(Time stamp, const Pose& T_W_S_original, std::uint32_t epoch) const {
  Station station{
      .stamp = stamp, .epoch = epoch, .T_W_S_original = T_W_S_original, .world_epoch = epoch, .T_W_S = T_W_S_original};
  const CorrectionField::Delta delta = correction_.deltaAt(stamp, epoch);
  if (delta.coverage == CorrectionField::Coverage::kNone) return station;
  cover(station, delta.coverage);
  station.T_W_S = delta.T_Wnew_Wold() * T_W_S_original;
  return station;
}

std::optional<Pose> Chain::edgeBetween(const Station& older, const Station& newer) {
  const bool same_correction = older.correction_serial == newer.correction_serial;
  const bool same_world = older.world_epoch == newer.world_epoch;
  if (same_correction && same_world) return relativePose(older.T_W_S, newer.T_W_S);
  // A window that reaches only one of the two says nothing about the motion between them.
  if (older.epoch == newer.epoch) return relativePose(older.T_W_S_original, newer.T_W_S_original);
  if (same_world) return relativePose(older.T_W_S, newer.T_W_S);
  return std::nullopt;
}

std::size_t Chain::admitWaiting() {
  const std::uint64_t inserted_before = counters_.views_inserted;
  while (!waiting_.empty() && !admit(waiting_.front()).waiting) waiting_.popFront();
  return static_cast<std::size_t>(counters_.views_inserted - inserted_before);
}

Chain::ViewOutcome Chain::admit(const ViewPtr& view) {
  if (!links_.empty() && view->stamp() < links_.front().station.stamp) return drop(ViewDrop::kLate);
  const PoseBuffer::Lookup pose = poses_.interpolate(view->stamp());
  switch (pose.status) {
    case PoseBuffer::LookupStatus::kAfterNewest:
      return {true, std::nullopt};
    case PoseBuffer::LookupStatus::kBeforeOldest:
      return drop(ViewDrop::kNoPose);
    case PoseBuffer::LookupStatus::kBetweenEpochs:
      return drop(ViewDrop::kBetweenEpochs);
    case PoseBuffer::LookupStatus::kGap:
      return drop(ViewDrop::kPoseGap);
    case PoseBuffer::LookupStatus::kFound:
      break;
  }
  if (links_.full()) {
    links_.popBack();
    ++counters_.views_retired;
  }
  const Pose T_W_C = pose.T_W_B * view->camera().parameters().T_B_C;
  links_.pushFront({view, stationAt(view->stamp(), T_W_C, pose.epoch), std::nullopt, std::nullopt});
  ++counters_.views_inserted;
  if (links_.size() > 1) {
    Link& older = links_[1];
    older.T_this_newer = edgeBetween(older.station, links_[0].station);
    older.increment_covariance_W_m2 = incrementBetween(older.station.stamp, view->stamp());
    if (parameters_.drift.use_increments && !older.increment_covariance_W_m2) ++counters_.increments_missing;
  }
  return {};
}

Chain::ViewOutcome Chain::drop(ViewDrop reason) {
  ++counters_.views_dropped[static_cast<std::size_t>(reason)];
  return {false, reason};
}

}  // namespace nanomap
