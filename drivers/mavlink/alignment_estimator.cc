#include "drivers/mavlink/alignment_estimator.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "core/level_frame.h"

namespace nanomap {
namespace {

constexpr std::size_t kWorldPoses = 512;   // five seconds at 100 Hz: far more than the autopilot is late or early
constexpr std::size_t kWaitingPoses = 64;  // autopilot poses whose time the VIO has not reached yet
constexpr Duration kMaxWorldPoseGap = std::chrono::milliseconds(100);

void require(bool condition, const char* parameter, const char* rule) {
  if (!condition) throw std::invalid_argument(std::string("alignment: ") + parameter + " must " + rule);
}

const AlignmentParameters& checked(const AlignmentParameters& parameters) {
  require(parameters.min_spacing > Duration::zero(), "min_spacing", "be positive");
  require(parameters.min_pairs >= 2, "min_pairs", "be at least 2");
  require(parameters.window / parameters.min_spacing >= static_cast<std::int64_t>(parameters.min_pairs), "window",
          "hold at least min_pairs pairs at min_spacing");
  require(parameters.place_window > parameters.min_spacing && parameters.place_window <= parameters.window,
          "place_window", "lie between min_spacing and window");
  require(parameters.max_age > parameters.min_spacing, "max_age", "exceed min_spacing");
  require(parameters.max_position_residual_m > 0.0 && parameters.max_heading_residual_rad > 0.0, "max_..._residual",
          "be positive");
  require(parameters.jump_m > 0.0 && parameters.jump_rad > 0.0, "jump_m and jump_rad", "be positive");
  require(parameters.jump_pairs >= 2 && parameters.jump_pairs <= parameters.min_pairs, "jump_pairs",
          "lie between 2 and min_pairs");
  require(parameters.follow_m_s > 0.0 && parameters.follow_rad_s > 0.0, "follow_m_s and follow_rad_s", "be positive");
  require(parameters.weights.attitude_sigma_rad > 0.0 && parameters.weights.position_sigma_m > 0.0, "weights",
          "be positive");
  return parameters;
}

bool isFinite(const AutopilotPose& pose) { return pose.position_NED_m.allFinite() && std::isfinite(pose.heading_rad); }

}  // namespace

std::string_view toString(AlignmentVerdict verdict) {
  switch (verdict) {
    case AlignmentVerdict::kUnknown:
      return "unknown";
    case AlignmentVerdict::kGood:
      return "good";
    case AlignmentVerdict::kInconsistent:
      return "inconsistent";
  }
  return "?";
}

AlignmentEstimator::AlignmentEstimator(const AlignmentParameters& parameters)
    : parameters_(checked(parameters)),
      world_poses_(kWorldPoses, kMaxWorldPoseGap),
      waiting_(kWaitingPoses),
      window_(static_cast<std::size_t>(parameters.window / parameters.min_spacing) + 1),
      suspects_(parameters.jump_pairs) {}

void AlignmentEstimator::addWorldPose(const BodyPose& pose) {
  if (world_poses_.insert(pose) == PoseVerdict::kAccepted) pairWaiting();
}

void AlignmentEstimator::addAutopilotPose(const AutopilotPose& pose) {
  if (!isFinite(pose) || (newest_autopilot_ && pose.stamp <= *newest_autopilot_)) {
    ++counters_.disordered;
    return;
  }
  newest_autopilot_ = pose.stamp;
  if (waiting_.full()) {
    waiting_.popFront();
    ++counters_.dropped;
  }
  waiting_.pushBack(pose);
  pairWaiting();
}

void AlignmentEstimator::pairWaiting() {
  while (!waiting_.empty()) {
    const AutopilotPose& autopilot = waiting_.front();
    const PoseBuffer::Lookup world = world_poses_.interpolate(autopilot.stamp);
    if (world.status == PoseBuffer::LookupStatus::kAfterNewest) return;
    if (world.status == PoseBuffer::LookupStatus::kFound) {
      addPair({autopilot.stamp, world.T_W_B.translation_m, yawOf(world.T_W_B.rotation), autopilot.position_NED_m,
               autopilot.heading_rad},
              world.epoch);
    } else {
      ++counters_.unmatched;
    }
    waiting_.popFront();
  }
}

void AlignmentEstimator::addPair(const AlignmentPair& pair, std::uint32_t epoch) {
  if (epoch != epoch_) {
    startAnew(epoch);
    after_jump_ = false;
    T_NED_W_.reset();
  }
  const RingBuffer<AlignmentPair>& newest = suspects_.empty() ? window_ : suspects_;
  const Duration elapsed = newest.empty() ? parameters_.min_spacing : pair.stamp - newest.back().stamp;
  if (elapsed < parameters_.min_spacing) return;
  ++counters_.pairs;
  if (fit_ && jumpedWith(pair)) return;
  keep(pair);
  // Streams that were away for long do not earn a long step.
  follow(std::min(elapsed, parameters_.max_age));
}

bool AlignmentEstimator::jumpedWith(const AlignmentPair& pair) {
  const AlignmentResiduals off = residualsOf(pair, *fit_);
  if (off.position_m <= parameters_.jump_m && off.heading_rad <= parameters_.jump_rad) {
    counters_.outliers += suspects_.size();
    while (!suspects_.empty()) suspects_.popFront();
    return false;
  }
  suspects_.pushBack(pair);
  if (!suspects_.full()) return true;

  RingBuffer<AlignmentPair> since = suspects_;
  startAnew(epoch_);
  after_jump_ = true;
  ++jumps_;
  if (last_jump_ && pair.stamp - *last_jump_ < parameters_.window) unsettled_until_ = pair.stamp + parameters_.window;
  last_jump_ = pair.stamp;
  for (; !since.empty(); since.popFront()) keep(since.front());
  follow(Duration::zero());
  return true;
}

void AlignmentEstimator::keep(const AlignmentPair& pair) {
  while (!window_.empty() && (window_.full() || pair.stamp - window_.front().stamp > parameters_.window)) {
    window_.popFront();
  }
  window_.pushBack(pair);
}

void AlignmentEstimator::startAnew(std::uint32_t epoch) {
  epoch_ = epoch;
  fit_.reset();
  while (!window_.empty()) window_.popFront();
  while (!suspects_.empty()) suspects_.popFront();
}

void AlignmentEstimator::follow(Duration elapsed) {
  const bool enough = window_.size() >= parameters_.min_pairs;
  if (!enough && !after_jump_) return;
  const NedFromWorld of_window = fitAlignment(window_, parameters_.weights);
  const NedFromWorld fit = placedByNewest(window_, of_window.heading_rad(), parameters_.place_window);
  // About the vehicle: a turn about W's origin would throw a setpoint far from it.
  const Vec3& at_W = window_.back().position_W_m;
  if (!T_NED_W_ || after_jump_) {
    T_NED_W_ = fit;
  } else {
    const double most_rad = parameters_.follow_rad_s * toSeconds(elapsed);
    const double turn_rad = std::clamp(wrapAngle(fit.heading_rad() - T_NED_W_->heading_rad()), -most_rad, most_rad);
    const double heading_rad = T_NED_W_->heading_rad() + turn_rad;
    const Vec3 shift_m = fit.point(at_W) - T_NED_W_->point(at_W);
    const double share = std::min(1.0, parameters_.follow_m_s * toSeconds(elapsed) / std::max(shift_m.norm(), 1e-9));
    const Vec3 vehicle_NED = T_NED_W_->point(at_W) + share * shift_m;
    T_NED_W_ = NedFromWorld(heading_rad, vehicle_NED - NedFromWorld(heading_rad, Vec3::Zero()).point(at_W));
  }
  const AlignmentResiduals unexplained = medianResiduals(window_, of_window);
  residuals_ = {std::max(unexplained.position_m, (fit.point(at_W) - T_NED_W_->point(at_W)).norm()),
                std::max(unexplained.heading_rad, std::abs(wrapAngle(fit.heading_rad() - T_NED_W_->heading_rad())))};
  // A jump is told against what the window says, which a few pairs do not.
  if (enough) {
    fit_ = fit;
    after_jump_ = false;
  }
}

Alignment AlignmentEstimator::alignment(Time now) const {
  Alignment alignment;
  alignment.T_NED_W = T_NED_W_;
  alignment.position_residual_m = residuals_.position_m;
  alignment.heading_residual_rad = residuals_.heading_rad;
  alignment.pairs = window_.size();
  alignment.epoch = epoch_;
  alignment.jumps = jumps_;
  const bool fresh = !window_.empty() && now - window_.back().stamp <= parameters_.max_age;
  const bool enough = window_.size() >= parameters_.min_pairs;
  if (!T_NED_W_ || !fresh || !(enough || after_jump_)) {
    alignment.verdict = AlignmentVerdict::kUnknown;
  } else if (after_jump_ || window_.back().stamp < unsettled_until_ ||
             residuals_.position_m > parameters_.max_position_residual_m ||
             residuals_.heading_rad > parameters_.max_heading_residual_rad) {
    alignment.verdict = AlignmentVerdict::kInconsistent;
  } else {
    alignment.verdict = AlignmentVerdict::kGood;
  }
  return alignment;
}

}  // namespace nanomap
