#include "tools/replay/arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace nanomap {
namespace {

/// Thirty years: what lies behind is a slip of the pen, and its nanoseconds still fit.
constexpr double kLongestLog_s = 1e9;
constexpr double kMinRate = 1e-3;
constexpr double kMaxRate = 1e6;
constexpr double kFarthestGoal_m = 1e6;
constexpr double kMinSpeed_m_s = 0.01;
constexpr double kMaxSpeed_m_s = 100.0;

void require(bool condition, const std::string& message) {
  if (!condition) throw std::runtime_error(message);
}

/// NaN is in no range.
void requireInRange(const std::string& option, double value, double min, double max) {
  require(value >= min && value <= max, fmt::format("{} {}: must be in {} .. {}", option, value, min, max));
}

bool isSameFile(const std::filesystem::path& a, const std::filesystem::path& b) {
  std::error_code no_such_file;
  return std::filesystem::equivalent(a, b, no_such_file) ||
         std::filesystem::absolute(a).lexically_normal() == std::filesystem::absolute(b).lexically_normal();
}

}  // namespace

void declare(CLI::App& app, ReplayArguments& arguments) {
  auto* log = app.add_option("LOG", arguments.logs,
                             "LCM log of depth frames, poses, corrections and goals; several are the parts of one\n"
                             "recording, and a folder of recordings is its latest flight");
  auto* out = app.add_option("--out", arguments.out, "LCM log of answers to write");
  auto* decisions = app.add_option("--decisions", arguments.decisions, "LCM log of decisions to write");
  app.add_option("--config", arguments.config,
                 "configuration file (TOML); without it, the one in the log, or defaults");
  app.add_option("--set", arguments.overrides, "section.key=value: wins over the file; may be repeated")
      ->allow_extra_args(false);
  app.add_option("--goal", arguments.goal_W_m, "x,y,z [m] in the estimator's world: fly there, not to the log's goal")
      ->delimiter(',')
      ->expected(3)
      ->allow_extra_args(false);
  app.add_option("--goal-speed", arguments.goal_speed_m_s, "soft top speed [m/s] on the way to --goal")
      ->capture_default_str();
  app.add_option("--rate", arguments.rate, "times real time; without it, as fast as it goes");
  app.add_option("--from", arguments.from_s, "start this many seconds into the log");
  app.add_option("--to", arguments.to_s, "end this many seconds into the log");
  auto* why = app.add_option("--why", arguments.why_s,
                             "explain the first plan from this many seconds into the log on: every candidate, its "
                             "risk, its veto")
                  ->excludes(out, decisions);
  app.add_option("--candidate", arguments.candidate, "with --why: show this candidate's samples, not the chosen one's")
      ->needs(why);
  app.add_option("--diff", arguments.diff,
                 "compare the decisions of two logs: where they part, and why; exit code 0 if they agree, 1 if not,\n"
                 "2 if they cannot be read")
      ->expected(2)
      ->excludes(log, out, decisions, why);
  app.add_flag("--check-config", arguments.check_config, "check the configuration, print what holds, and end");
  app.add_flag("--help-config", arguments.help_config, "print the default configuration with every key explained");
}

ReplayOptions optionsFrom(const ReplayArguments& arguments) {
  requireInRange("--from", arguments.from_s, 0.0, kLongestLog_s);
  requireInRange("--to", arguments.to_s.value_or(kLongestLog_s), 0.0, kLongestLog_s);
  requireInRange("--why", arguments.why_s.value_or(0.0), 0.0, kLongestLog_s);
  requireInRange("--rate", arguments.rate.value_or(1.0), kMinRate, kMaxRate);
  requireInRange("--goal-speed", arguments.goal_speed_m_s, kMinSpeed_m_s, kMaxSpeed_m_s);
  for (const double coordinate_m : arguments.goal_W_m) {
    requireInRange("--goal", coordinate_m, -kFarthestGoal_m, kFarthestGoal_m);
  }
  require(!arguments.to_s || *arguments.to_s >= arguments.from_s, "--to must not be before --from");
  ReplayOptions options;
  options.span.from = fromSeconds(arguments.from_s);
  if (arguments.to_s) options.span.to = fromSeconds(*arguments.to_s);
  options.rate = arguments.rate;
  if (!arguments.goal_W_m.empty()) {
    options.goal.emplace();
    options.goal->position_W_m = Vec3::Map(arguments.goal_W_m.data());
    options.goal->top_speed_m_s = arguments.goal_speed_m_s;
  }
  return options;
}

void checkOutputs(const ReplayArguments& arguments, const std::vector<std::filesystem::path>& logs) {
  for (const auto& [option, path] :
       {std::pair("--out", arguments.out), std::pair("--decisions", arguments.decisions)}) {
    const auto& output = path;
    const bool is_log = !output.empty() && std::any_of(logs.begin(), logs.end(),
                                                       [&output](const auto& log) { return isSameFile(log, output); });
    require(!is_log, fmt::format("{} {} is the log itself: name another file", option, path));
  }
  require(arguments.out.empty() || arguments.decisions.empty() || !isSameFile(arguments.out, arguments.decisions),
          fmt::format("--out and --decisions are both {}: name two files", arguments.out));
}

}  // namespace nanomap
