#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <numeric>
#include <string>
#include <vector>

#include "drivers/lcm/decode.h"
#include "nanomap/answers_t.hpp"
#include "tests/support/flight_log.h"
#include "tools/replay/replay.h"

namespace nanomap::test {

template <class Enum, class Counters>
std::uint64_t countOf(const Counters& counters, Enum value) {
  return counters[static_cast<std::size_t>(value)];
}

template <class Counters>
std::uint64_t sumOf(const Counters& counters) {
  return std::accumulate(counters.begin(), counters.end(), std::uint64_t{0});
}

inline ReplayReport replayed(const std::filesystem::path& path, const Configuration& configuration = {},
                             const ReplayOptions& options = {}) {
  LogReader log(path);
  return replay(log, configuration, options);
}

/// Replays into a log of answers. @return its path
inline std::filesystem::path answersOf(const std::filesystem::path& path, const std::string& name,
                                       const Configuration& configuration = {}, const ReplayOptions& options = {}) {
  LogReader log(path);
  const std::filesystem::path out = testFile(name);
  LogWriter answers(out);
  (void)replay(log, configuration, options, {.answers = &answers});
  answers.close();
  return out;
}

/// Replays into a log of decisions. @return its path
inline std::filesystem::path decisionsOf(const std::filesystem::path& path, const std::string& name,
                                         const Configuration& configuration = {}, const ReplayOptions& options = {}) {
  LogReader log(path);
  const std::filesystem::path out = testFile(name);
  LogWriter decisions(out);
  (void)replay(log, configuration, options, {.decisions = &decisions});
  decisions.close();
  return out;
}

struct StampedAnswers {
  Time log_stamp{};
  answers_t answers;
};

inline std::vector<StampedAnswers> readAnswers(const std::filesystem::path& path) {
  LogReader log(path);
  std::vector<StampedAnswers> all;
  std::vector<std::uint8_t> message;
  for (const LogEvent& event : log.events()) {
    log.read(event, message);
    all.push_back({event.log_stamp, std::get<answers_t>(decode<answers_t>(message))});
  }
  return all;
}

inline std::string bytesOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Every depth message is in the chain, waiting, or dropped for one reason.
inline void expectEveryFrameCounted(const ReplayReport& report) {
  const auto depth = static_cast<std::size_t>(InputKind::kDepth);
  EXPECT_EQ(report.pipeline.messages[depth],
            sumOf(report.pipeline.decode_faults[depth]) + sumOf(report.pipeline.convert_faults[depth]) +
                sumOf(report.pipeline.camera_faults) + sumOf(report.pipeline.image_faults) +
                report.chain.viewsDropped() + report.stuck_views + report.chain.views_inserted + report.views_waiting);
}

}  // namespace nanomap::test
