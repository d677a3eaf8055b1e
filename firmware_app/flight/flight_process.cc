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

/// Views that are on their way, or held by a snapshot that nobody has replaced yet.
constexpr std::size_t kViewsUnderWay = 32;

SinkParameters sinkParameters(const Configuration& configuration) {
  SinkParameters sink;
  sink.safety = configuration.safety;
  sink.alignment = configuration.mavlink.alignment;
  sink.max_yaw_rate_rad_s = configuration.planner.heading.max_rate_rad_s;
  sink.send_obstacles = configuration.mavlink.send_obstacles;
  sink.obstacle_band = configuration.mavlink.obstacle_band;
  sink.query = configuration.planner.risk.query;
  sink.recording = configuration.lcm.clock == ClockDomain::kLog;
  sink.send_odometry = configuration.mavlink.send_odometry;
  return sink;
}

ViewBuilder viewBuilder(const Configuration& configuration) {
  const ChainParameters& chain = configuration.chain;
  return ViewBuilder(configuration.camera, configuration.index,
                     chain.history_views + chain.waiting_views + kViewsUnderWay);
}

template <class Work>
void timed(SlotQueue<Duration>& times, Work&& work) {
  const Time start = processNow();
  if (work()) times.push([&](Duration& slot) { slot = processNow() - start; });
}

}  // namespace

FlightProcess::FlightProcess(const Configuration& configuration, const FlightOptions& options, MessageSource& source,
                             AutopilotLink& link)
    : options_(options),
      hand_overs_(configuration.chain.history_views),
      setpoint_period_(fromSeconds(1.0 / configuration.mavlink.setpoint_rate_hz)),
      ingest_(configuration.lcm, StampClock(configuration.lcm.clock, realtimeAhead()),
              {hand_overs_.inputs, hand_overs_.chain_bell, hand_overs_.frames, hand_overs_.capture_bell,
               hand_overs_.cameras, hand_overs_.index_bell, hand_overs_.ingest_counters}),
      depth_source_(hand_overs_.frames, hand_overs_.capture_bell),
      index_(viewBuilder(configuration), {hand_overs_.cameras, hand_overs_.captured, hand_overs_.indexed,
                                          hand_overs_.chain_bell, hand_overs_.index_counters}),
      chain_(configuration.chain, configuration.camera.has_value(),
             {hand_overs_.inputs, hand_overs_.indexed, hand_overs_.vehicle, hand_overs_.newest, hand_overs_.moments,
              hand_overs_.planner_bell, hand_overs_.steps, hand_overs_.chain_counters}),
      plan_(configuration.planner, {hand_overs_.moments, hand_overs_.flown, hand_overs_.plans, hand_overs_.decisions,
                                    hand_overs_.newest_decision}),
      sink_(sinkParameters(configuration), link,
            {hand_overs_.vehicle, hand_overs_.plans, hand_overs_.newest, hand_overs_.flown, hand_overs_.stalled,
             hand_overs_.setpoints, hand_overs_.sink_report, hand_overs_.setpoint_latencies}) {
  const auto realtime = [&](RealtimeThread thread) {
    return ThreadSettings{std::string(toString(thread)), options_.layout[thread], kDefaultStackBytes,
                          options_.demand_realtime};
  };
  const auto plain = [](std::string name) {
    ThreadSettings settings;
    settings.name = std::move(name);
    return settings;
  };
  const auto start = [this](const ThreadSettings& settings, std::function<void()> wait, std::function<void()> work) {
    workers_.push_back(std::make_unique<Worker>(settings, std::move(wait), std::move(work)));
  };
  start(
      plain("mavlink"), [this] { sleepUntil(next_setpoint_); }, [this] { sink(); });
  start(
      realtime(RealtimeThread::kPlanner), [this] { hand_overs_.planner_bell.wait(kLongestWait); }, [this] { plan(); });
  start(
      realtime(RealtimeThread::kChain), [this] { hand_overs_.chain_bell.wait(kLongestWait); }, [this] { chain(); });
  start(
      realtime(RealtimeThread::kIndex), [this] { hand_overs_.index_bell.wait(kLongestWait); }, [this] { index(); });
  start(
      realtime(RealtimeThread::kCapture), [this] { captured_one_ = depth_source_.capture(captured_, kLongestWait); },
      [this] { capture(); });
  start(
      plain("ingest"), [] {}, [this, &source] { ingest(source); });

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
    const auto kind = ingest_.kindOf(message.channel);
    if (!kind) return;
    const Time arrival = ingest_.arrivalAt(processNow());
    options_.on_message(message, arrival);
    ingest_.take(*kind, message.bytes, arrival);
  });
  if (wait == MessageSource::Wait::kEnded) source_ended_.store(true, std::memory_order_relaxed);
}

void FlightProcess::capture() {
  if (!captured_one_) return;
  hand_overs_.captured.push([this](ArrivedFrame& slot) { std::swap(slot, captured_); });
  hand_overs_.index_bell.ring();
}

void FlightProcess::index() {
  timed(hand_overs_.index_times, [this] { return index_.run() > 0; });
}

void FlightProcess::chain() {
  timed(hand_overs_.chain_times, [this] { return chain_.run(processNow()) > 0; });
}

void FlightProcess::plan() {
  timed(hand_overs_.plan_times, [this] { return plan_.run(processNow()); });
}

void FlightProcess::sink() {
  const Time now = processNow();
  if (now - next_setpoint_ > setpoint_period_ / 2) {
    if (next_setpoint_ != Time{}) late_setpoints_.fetch_add(1, std::memory_order_relaxed);
    next_setpoint_ = now;  // what was missed is not made up for
  }
  sink_.run(now);
  next_setpoint_ += setpoint_period_;
}

void FlightProcess::watch() {
  next_watch_ = processNow() + kWatchPeriod;
  const auto stalls = watchdog_->judge(processNow());
  for (const Stall& stall : stalls) stalls_.push([&](Stall& slot) { slot = stall; });
  hand_overs_.stalled.store(!stalls.empty(), std::memory_order_relaxed);
}

}  // namespace nanomap
