#include "firmware_app/flight/flight_process.h"

#include <utility>

#include "firmware_app/flight/process_clock.h"

namespace nanomap {
namespace {

/// How long a thread sleeps at most before it looks whether it is to stop.
constexpr Duration kLongestWait = std::chrono::milliseconds(100);

constexpr Duration kWatchPeriod = std::chrono::milliseconds(20);

/// What a thread that answers needs for one piece of work, many times over; for plain threads, on a busy machine.
constexpr Duration kLongestStageWork = std::chrono::milliseconds(300);
constexpr Duration kLongestPlainWork = std::chrono::seconds(1);
constexpr Duration kLongestIdle = std::chrono::seconds(1);

template <class Work>
void timed(SlotQueue<Duration>& times, Work&& work) {
  const Time start = processNow();
  if (work()) times.push([&](Duration& slot) { slot = processNow() - start; });
}

}  // namespace

FlightProcess::FlightProcess(const FlightOptions& options, MessageSource& source, Stages& stages)
    : options_(options),
      setpoint_period_(fromSeconds(1.0 / options.setpoint_rate_hz)),
      stages_(stages),
      index_deadline_(options.frame_deadline),
      chain_deadline_(options.frame_deadline),
      planner_deadline_(options.frame_deadline) {
  const auto realtime = [&](RealtimeThread thread) {
    return ThreadSettings{std::string(toString(thread)), options_.layout[thread], kDefaultStackBytes,
                          options_.demand_realtime};
  };
  const auto start = [this](const ThreadSettings& settings, std::function<void()> wait, std::function<void()> work) {
    workers_.push_back(std::make_unique<Worker>(settings, std::move(wait), std::move(work)));
  };
  start(
      {.name = "mavlink"}, [this] { sleepUntil(next_setpoint_); }, [this] { sink(); });
  start(
      realtime(RealtimeThread::kPlanner), [this] { stages_.hand_overs.planner_bell.wait(kLongestWait); },
      [this] { plan(); });
  start(
      realtime(RealtimeThread::kChain), [this] { stages_.hand_overs.chain_bell.wait(kLongestWait); },
      [this] { chain(); });
  start(
      realtime(RealtimeThread::kIndex), [this] { stages_.hand_overs.index_bell.wait(kLongestWait); },
      [this] { index(); });
  start(
      realtime(RealtimeThread::kCapture), [] {}, [this] { stages_.capture(kLongestWait); });
  start(
      {.name = "ingest"}, [] {}, [this, &source] { ingest(source); });

  std::vector<WatchedThread> watched;
  for (const auto& worker : workers_) {
    const bool has_place = worker->settings().place.has_value();
    watched.push_back({worker->settings().name, &worker->progress(), has_place ? kLongestStageWork : kLongestPlainWork,
                       kLongestIdle});
  }
  watchdog_ = std::make_unique<Watchdog>(std::move(watched), 5 * kWatchPeriod);
  watcher_ = std::make_unique<Worker>(
      realtime(RealtimeThread::kWatchdog), [this] { sleepUntil(next_watch_); }, [this] { watch(); });
}

FlightProcess::~FlightProcess() {
  watcher_.reset();
  for (const auto& worker : workers_) worker->requestStop();
}

std::vector<const Worker*> FlightProcess::workers() const {
  std::vector<const Worker*> all;
  for (const auto& worker : workers_) all.push_back(worker.get());
  all.push_back(watcher_.get());
  return all;
}

bool FlightProcess::allAnswer() const {
  const bool watched = processNow() - watched_.load(std::memory_order_relaxed) <= kLongestIdle;
  return watched && !stages_.hand_overs.stalled.load(std::memory_order_relaxed);
}

std::vector<std::string> FlightProcess::takeStalls() {
  std::vector<std::string> texts;
  while (stalls_.pop([&](const Stall& stall) { texts.push_back(toText(stall)); })) {
  }
  return texts;
}

void FlightProcess::ingest(MessageSource& source) {
  if (sourceEnded()) {
    sleepUntil(processNow() + kLongestWait);
    return;
  }
  const auto wait = source.wait(kLongestWait, [this](const ReceivedMessage& message) {
    const auto kind = stages_.ingest.kindOf(message.channel);
    if (!kind) return;
    const Time now = processNow();
    stages_.ingest.noteRealtime(realtimeAhead(), now);
    const Time arrival = stages_.ingest.arrivalAt(now);
    options_.on_message(message, arrival);
    stages_.ingest.take(*kind, message.bytes, arrival);
  });
  if (wait == MessageSource::Wait::kEnded) source_ended_.store(true, std::memory_order_relaxed);
}

void FlightProcess::index() {
  timed(stages_.hand_overs.index_times, [this] { return stages_.index.run() > 0; });
  if (const auto frame = stages_.index.newestFrame()) index_deadline_.done(*frame, processNow());
}

void FlightProcess::chain() {
  timed(stages_.hand_overs.chain_times, [this] { return stages_.chain.run(processNow()) > 0; });
  if (const auto frame = stages_.chain.newestFrame()) chain_deadline_.done(*frame, processNow());
}

void FlightProcess::plan() {
  timed(stages_.hand_overs.plan_times, [this] { return stages_.plan.run(processNow()); });
  planner_deadline_.done(stages_.plan.newestFrame(), processNow());
}

void FlightProcess::sink() {
  const Time now = processNow();
  if (now - next_setpoint_ > setpoint_period_ / 2) {
    if (next_setpoint_ != Time{}) late_setpoints_.fetch_add(1, std::memory_order_relaxed);
    next_setpoint_ = now;  // what was missed is not made up for
  }
  stages_.sink.run(now);
  next_setpoint_ += setpoint_period_;
}

void FlightProcess::watch() {
  const Time now = processNow();
  next_watch_ = now + kWatchPeriod;
  const auto stalls = watchdog_->judge(now);
  for (const Stall& stall : stalls) stalls_.push([&](Stall& slot) { slot = stall; });
  stages_.hand_overs.stalled.store(!stalls.empty(), std::memory_order_relaxed);
  watched_.store(now, std::memory_order_relaxed);
}

}  // namespace nanomap
