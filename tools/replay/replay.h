#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/goal.h"
#include "core/query_statistics.h"
#include "drivers/recording/log_reader.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/pipeline.h"
#include "tools/replay/fan.h"
#include "tools/replay/flown_path.h"
#include "tools/replay/plan_statistics.h"
#include "tools/replay/playback.h"

namespace nanomap {

/// Which part of a log, how fast, and what is asked of it.
struct ReplayOptions {
  LogSpan span;
  std::optional<double> rate{};  ///< times real time; empty: as fast as it goes
  std::optional<Goal> goal{};    ///< instead of the log's, always of the world that the vehicle is in
  FanParameters fan{};
  FlownPathParameters flown_path{};
};

/// Logs to write; null: not written. One log may hold both.
struct ReplayOutputs {
  LogWriter* answers = nullptr;
  LogWriter* decisions = nullptr;
};

/// All that a replay found out, answers and decisions aside.
struct ReplayReport {
  explicit ReplayReport(std::size_t history_views) : fan(history_views), flown_path(history_views) {}

  std::map<std::string, std::uint64_t> events_by_channel;  ///< in the whole log
  std::vector<LogDamage> damage;
  Time log_start{};                 ///< of the log's first event
  Duration log_span{};              ///< between the log's first and last event
  std::optional<StepReport> steps;  ///< if the log is a recorded flight
  PipelineCounters pipeline;
  ChainCounters chain;
  std::uint64_t stuck_views = 0;      ///< left out: the camera showed one picture while the vehicle moved
  std::size_t views_waiting = 0;      ///< still without a pose at the end
  std::uint64_t answered_frames = 0;  ///< messages of answers
  QueryStatistics fan;
  QueryStatistics flown_path;
  PlanStatistics plans;
  std::vector<Duration> camera_changes;  ///< when, after the log's first event
  std::string last_camera_fault;
  bool has_camera = false;
  std::vector<Duration> build_times;  ///< measured, one a view
  std::vector<Duration> query_times;  ///< measured, one a batch
  std::vector<Duration> point_times;  ///< the same, divided by the batch's points
  std::vector<Duration> plan_times;   ///< measured, one a decision
};

/// Runs the log through a pipeline and the planner on this thread. Whenever a view enters the chain, the fan of motions
/// and the flight's own next seconds are answered and a plan is made, each for the snapshot's stamp. A recording of the
/// flight process is taken in and planned for in the order and at the times that it holds instead (StepPlayback).
/// Answers and decisions are a function of the log, the configuration and the options: they hold no measured time, and
/// carry the log time of the event that made them, or of the recorded decision.
/// @throws std::runtime_error if the log holds no event; std::invalid_argument for a configuration that cannot be;
///         LogError if a log cannot be read or written
[[nodiscard]] ReplayReport replay(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                                  const ReplayOutputs& outputs = {});

}  // namespace nanomap
