#include "tools/replay/replay.h"

#include <chrono>
#include <thread>

#include "planner/receding_horizon.h"
#include "tools/replay/answers.h"
#include "tools/replay/moment.h"

namespace nanomap {
namespace {

using Clock = std::chrono::steady_clock;

/// Holds log time back to a multiple of real time.
class Pacer {
 public:
  Pacer(std::optional<double> rate, Time start) : rate_(rate), log_start_(start) {}

  void waitFor(Time log_stamp) const {
    if (!rate_) return;
    std::this_thread::sleep_until(start_ + fromSeconds(toSeconds(log_stamp - log_start_) / *rate_));
  }

 private:
  std::optional<double> rate_;
  Time log_start_;
  Clock::time_point start_ = Clock::now();
};

/// Asks about the space ahead, counts and writes the answers.
class Answerer {
 public:
  Answerer(const Configuration& configuration, const ReplayOptions& options, const FlownPath& flown_path,
           LogWriter* log, ReplayReport& report)
      : configuration_(configuration), options_(options), flown_path_(flown_path), log_(log), report_(report) {}

  void answer(const ChainSnapshot& snapshot, double range_m, Time log_stamp) {
    std::vector<UncertainPoint> points_B = fanPoints(options_.fan, snapshot.T_W_B.rotation, range_m);
    const std::size_t fan_count = points_B.size();
    const auto flown_B = flown_path_.ahead(snapshot, options_.flown_path);
    points_B.insert(points_B.end(), flown_B.begin(), flown_B.end());

    replies_.resize(points_B.size());
    const Clock::time_point start = Clock::now();
    queryBatch(snapshot, points_B, configuration_.planner.risk.query, replies_);
    const Duration elapsed = Clock::now() - start;
    report_.query_times.push_back(elapsed);
    report_.point_times.push_back(elapsed / static_cast<std::int64_t>(points_B.size()));

    for (std::size_t i = 0; i < replies_.size(); ++i) {
      (i < fan_count ? report_.fan : report_.flown_path).record(replies_[i]);
    }
    ++report_.answered_frames;
    if (log_ != nullptr) {
      log_->write(configuration_.lcm.answers_channel, log_stamp, toMessage(snapshot, points_B, replies_, fan_count));
    }
  }

 private:
  const Configuration& configuration_;
  const ReplayOptions& options_;
  const FlownPath& flown_path_;
  LogWriter* log_;
  ReplayReport& report_;
  std::vector<QueryReply> replies_;
};

/// Plans, counts and writes the decisions.
class Decider {
 public:
  Decider(const Configuration& configuration, LogWriter* log, ReplayReport& report)
      : horizon_(configuration.planner), channel_(configuration.lcm.decisions_channel), log_(log), report_(report) {}

  void decide(const Moment& moment, const PlanPoint& plan) {
    const Clock::time_point start = Clock::now();
    if (!plan.place.flown) horizon_.release();
    const Decision decision = horizon_.step(moment.snapshot, moment.state, moment.goal, moment.now);
    report_.plan_times.push_back(Clock::now() - start);
    if (log_ != nullptr) log_->write(channel_, plan.log_stamp, toMessage(decision, plan.place));
    report_.plans.record(decision);
  }

 private:
  RecedingHorizon horizon_;
  const std::string& channel_;
  LogWriter* log_;
  ReplayReport& report_;
};

}  // namespace

ReplayReport replay(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                    const ReplayOutputs& outputs) {
  const auto playback = makePlayback(log, configuration, options.span);
  ReplayReport report(configuration.chain.history_views);
  report.log_start = playback->logStart();
  report.log_span = playback->logEnd() - playback->logStart();
  report.damage = log.damage();
  for (const LogEvent& event : log.events()) ++report.events_by_channel[log.channelOf(event)];

  const Pipeline& pipeline = playback->pipeline();
  const FlownPath flown_path(log, playback->events(), configuration);
  Answerer answerer(configuration, options, flown_path, outputs.answers, report);
  Decider decider(configuration, outputs.decisions, report);
  const Pacer pacer(options.rate, playback->logStart() + options.span.from);
  Moment moment;
  while (const auto next_stamp = playback->nextStamp()) {
    pacer.waitFor(*next_stamp);
    const auto [log_stamp, outcome, plans] = playback->advance();
    if (outcome.build_time) report.build_times.push_back(*outcome.build_time);
    if (outcome.camera == CameraVerdict::kChanged) report.camera_changes.push_back(log_stamp - playback->logStart());
    if (outcome.views_inserted > 0) {
      takeMoment(pipeline, std::nullopt, options.goal, moment);
      answerer.answer(moment.snapshot, pipeline.viewBuilder().camera()->frustum().far_m, log_stamp);
    }
    for (const PlanPoint& plan : plans) {
      takeMoment(pipeline, plan.now, options.goal, moment);
      decider.decide(moment, plan);
    }
  }

  report.steps = playback->stepReport();
  report.pipeline = pipeline.counters();
  report.chain = pipeline.chain().counters();
  report.stuck_views = pipeline.stuckViews();
  report.views_waiting = pipeline.chain().waitingCount();
  report.last_camera_fault = pipeline.viewBuilder().lastCameraFault();
  report.has_camera = pipeline.viewBuilder().camera() != nullptr;
  return report;
}

}  // namespace nanomap
