#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/query_statistics.h"
#include "drivers/recording/log_reader.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/pipeline.h"
#include "tools/replay/fan.h"
#include "tools/replay/flown_path.h"

namespace nanomap {

/// Which part of a log, and how fast.
struct ReplayOptions {
  Duration from{};             ///< after the log's first event
  std::optional<Duration> to;  ///< after the log's first event; empty: to its end
  std::optional<double> rate;  ///< times real time; empty: as fast as it goes
  FanParameters fan{};
  FlownPathParameters flown_path{};
};

/// All that a replay found out, the answers aside.
struct ReplayReport {
  explicit ReplayReport(std::size_t history_views) : fan(history_views), flown_path(history_views) {}

  std::map<std::string, std::uint64_t> events_by_channel;  ///< in the whole log
  std::vector<LogDamage> damage;
  Duration log_span{};  ///< between the log's first and last event
  PipelineCounters pipeline;
  ChainCounters chain;
  std::size_t views_waiting = 0;      ///< still without a pose at the end
  std::uint64_t answered_frames = 0;  ///< messages of answers
  QueryStatistics fan;
  QueryStatistics flown_path;
  std::vector<Duration> camera_changes;  ///< when, after the log's first event
  std::string last_camera_fault;
  bool has_camera = false;
  std::vector<Duration> build_times;  ///< measured, one a view
  std::vector<Duration> query_times;  ///< measured, one a batch
  std::vector<Duration> point_times;  ///< the same, divided by the batch's points
};

/// Runs the log through a pipeline on this thread, events merged by log time, and answers the fan of motions and the
/// flight's own next seconds whenever a view enters the chain. Camera models from before `from` are taken in as well.
/// The answers are a function of the log, the configuration and the options: they hold no measured time, and carry the
/// log time of the event that made them.
/// @param answers  where they are written; null: nowhere
/// @throws std::runtime_error if the log holds no event; std::invalid_argument for a configuration that cannot be;
///         LogError if a log cannot be read or written
[[nodiscard]] ReplayReport replay(LogReader& log, const Configuration& configuration, const ReplayOptions& options,
                                  LogWriter* answers);

}  // namespace nanomap
