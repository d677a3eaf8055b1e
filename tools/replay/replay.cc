#include "tools/replay/replay.h"

#include <algorithm>
#include <chrono>
#include <stdexcept>
#include <thread>

#include "tools/replay/answers.h"

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

  void answer(const Chain& chain, double range_m, Time log_stamp) {
    chain.snapshotInto(snapshot_);
    std::vector<UncertainPoint> points_B = fanPoints(options_.fan, snapshot_.T_W_B.rotation, range_m);
    const std::size_t fan_count = points_B.size();
    const auto flown_B = flown_path_.ahead(snapshot_, options_.flown_path);
    points_B.insert(points_B.end(), flown_B.begin(), flown_B.end());

    replies_.resize(points_B.size());
    const Clock::time_point start = Clock::now();
    queryBatch(snapshot_, points_B, configuration_.query, replies_);
    const Duration elapsed = Clock::now() - start;
    report_.query_times.push_back(elapsed);
    report_.point_times.push_back(elapsed / static_cast<std::int64_t>(points_B.size()));

    for (std::size_t i = 0; i < replies_.size(); ++i) {
      (i < fan_count ? report_.fan : report_.flown_path).record(replies_[i]);
    }
    ++report_.answered_frames;
    if (log_ != nullptr) {
      log_->write(configuration_.lcm.answers_channel, log_stamp, toMessage(snapshot_, points_B, replies_, fan_count));
    }
  }

 private:
  const Configuration& configuration_;
  const ReplayOptions& options_;
  const FlownPath& flown_path_;
  LogWriter* log_;
  ReplayReport& report_;
  ChainSnapshot snapshot_;
  std::vector<QueryReply> replies_;
};

}  // namespace

ReplayReport replay(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                    LogWriter* answers) {
  std::vector<LogEvent> events = log.mergedByTime();
  if (events.empty()) throw std::runtime_error("the log holds no event: was anything published while it was recorded?");
  const Time start = events.front().log_stamp;
  const Time from = start + options.from;

  ReplayReport report(configuration.chain.history_views);
  report.log_span = events.back().log_stamp - start;
  report.damage = log.damage();
  for (const LogEvent& event : events) ++report.events_by_channel[log.channelOf(event)];

  Pipeline pipeline(configuration);
  std::erase_if(events, [&](const LogEvent& event) {
    const auto kind = pipeline.kindOf(log.channelOf(event));
    return !kind || (event.log_stamp < from && *kind != InputKind::kCamera);
  });
  const FlownPath flown_path(log, events, configuration);
  Answerer answerer(configuration, options, flown_path, answers, report);
  const Pacer pacer(options.rate, from);
  std::vector<std::uint8_t> message;
  for (const LogEvent& event : events) {
    if (options.to && event.log_stamp > start + *options.to) break;
    pacer.waitFor(event.log_stamp);
    log.read(event, message);
    const Pipeline::Outcome outcome = pipeline.feed(*pipeline.kindOf(log.channelOf(event)), message);
    if (outcome.build_time) report.build_times.push_back(*outcome.build_time);
    if (outcome.camera == CameraVerdict::kChanged) report.camera_changes.push_back(event.log_stamp - start);
    if (outcome.views_inserted > 0) {
      answerer.answer(pipeline.chain(), pipeline.viewBuilder().camera()->frustum().far_m, event.log_stamp);
    }
  }

  report.pipeline = pipeline.counters();
  report.chain = pipeline.chain().counters();
  report.views_waiting = pipeline.chain().waitingCount();
  report.last_camera_fault = pipeline.viewBuilder().lastCameraFault();
  report.has_camera = pipeline.viewBuilder().camera() != nullptr;
  return report;
}

}  // namespace nanomap
