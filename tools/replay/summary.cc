#include "tools/replay/summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "tools/replay/percentile.h"
#include "tools/replay/plan_summary.h"
#include "tools/replay/text.h"
#include "tools/replay/warnings.h"

namespace nanomap {
namespace {

/// Of the paper's figure: how much the last 40 views answer.
constexpr std::size_t kRecentViews = 40;

/// Histogram rows: the first depth of each; the last row is open.
constexpr std::array<std::size_t, 9> kDepthRows = {0, 1, 2, 5, 10, 20, 40, 80, 160};
constexpr double kBarWidth = 40.0;

/// Of a recording: enough to see what happened.
constexpr std::size_t kShownLosses = 10;

void writeLog(Text& text, const ReplayReport& report) {
  std::uint64_t events = 0;
  for (const auto& [channel, count] : report.events_by_channel) events += count;
  text.line("log: {} events over {:.3f} s", events, toSeconds(report.log_span));
  for (const auto& [channel, count] : report.events_by_channel) text.line("    {:>8}  {}", count, channel);
  for (const LogDamage& damage : report.damage) {
    text.line("  damaged: {} bytes from offset {}: {}", damage.size_bytes, damage.offset_bytes, toString(damage.cause));
  }
}

void writeSteps(Text& text, const ReplayReport& report) {
  if (!report.steps) return;
  const StepReport& steps = *report.steps;
  text.line("order: {} steps, as the flight took things in; {}", steps.taken,
            steps.losses.empty() ? "nothing is missing" : fmt::format("{} losses", steps.losses.size()));
  for (std::size_t i = 0; i < std::min(steps.losses.size(), kShownLosses); ++i) {
    text.line("  after {:.3f} s: {}", toSeconds(steps.losses[i].at - report.log_start), steps.losses[i].what);
  }
  if (steps.losses.size() > kShownLosses) text.line("  and {} more", steps.losses.size() - kShownLosses);
  for (std::size_t i = 0; i < kInputKindCount; ++i) {
    if (steps.not_taken[i] == 0) continue;
    text.line("  {} {} arrived and were not taken in", steps.not_taken[i], toString(static_cast<InputKind>(i)));
  }
}

void writeFaults(Text& text, const ReplayReport& report, InputKind kind) {
  const auto i = static_cast<std::size_t>(kind);
  text.reasons<DecodeFault>(report.pipeline.decode_faults[i]);
  text.reasons<ConvertFault>(report.pipeline.convert_faults[i]);
}

std::uint64_t messages(const ReplayReport& report, InputKind kind) {
  return report.pipeline.messages[static_cast<std::size_t>(kind)];
}

void writeInputs(Text& text, const ReplayReport& report) {
  text.line("depth frames: {} in, {} inserted, {} still waiting for a pose", messages(report, InputKind::kDepth),
            report.chain.views_inserted, report.views_waiting);
  writeFaults(text, report, InputKind::kDepth);
  text.reasons<CameraFault>(report.pipeline.camera_faults);
  text.reasons<ImageFault>(report.pipeline.image_faults);
  text.reasons<ViewDrop>(report.chain.views_dropped);
  if (report.stuck_views > 0) text.line("    {:>8}  of a camera that is stuck", report.stuck_views);

  text.line("camera models: {} in", messages(report, InputKind::kCamera));
  writeFaults(text, report, InputKind::kCamera);
  text.reasons<CameraVerdict>(report.pipeline.cameras);

  text.line("poses: {} in", messages(report, InputKind::kPose));
  writeFaults(text, report, InputKind::kPose);
  text.reasons<PoseVerdict>(report.chain.poses);

  text.line("corrections: {} in; {} edges corrected, {} corrected poses without an original",
            messages(report, InputKind::kCorrection), report.chain.edges_corrected,
            report.chain.correction_poses_unmatched);
  writeFaults(text, report, InputKind::kCorrection);
  text.reasons<CorrectionVerdict>(report.chain.corrections);

  text.line("history: {} views retired, {} edges without increment covariances", report.chain.views_retired,
            report.chain.increments_missing);
}

void writeStatuses(Text& text, const ReplayReport& report) {
  text.line("answers: {} frames; {} points of the fan, {} of the path flown next", report.answered_frames,
            report.fan.total(), report.flown_path.total());
  text.line("  {:<14}{:>9}{:>9}", "status", "fan", "flown");
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    const auto status = static_cast<Status>(i);
    text.line("  {:<14}{:>8.2f}%{:>8.2f}%", toString(status), share(report.fan.withStatus(status), report.fan.total()),
              share(report.flown_path.withStatus(status), report.flown_path.total()));
  }
}

/// Points contained by views `first` .. `end` - 1 behind the newest.
std::uint64_t containedIn(const QueryStatistics& statistics, std::size_t first, std::size_t end) {
  const auto& depths = statistics.containedAtDepth();
  std::uint64_t sum = 0;
  for (std::size_t depth = first; depth < std::min(end, depths.size()); ++depth) sum += depths[depth];
  return sum;
}

void writeHistory(Text& text, const ReplayReport& report) {
  text.line("answered by the newest view: fan {:.1f}%, flown {:.1f}%; within the last {}: fan {:.1f}%, flown {:.1f}%",
            kPercent * report.fan.shareContainedWithin(1), kPercent * report.flown_path.shareContainedWithin(1),
            kRecentViews, kPercent * report.fan.shareContainedWithin(kRecentViews),
            kPercent * report.flown_path.shareContainedWithin(kRecentViews));
  text.line("  {:<14}{:>9}{:>9}", "views back", "fan", "flown");
  const std::size_t depths = report.fan.containedAtDepth().size();
  for (std::size_t row = 0; row < kDepthRows.size() && kDepthRows[row] < depths; ++row) {
    const std::size_t first = kDepthRows[row];
    const std::size_t end = std::min(row + 1 < kDepthRows.size() ? kDepthRows[row + 1] : depths, depths);
    const double fan_percent = share(containedIn(report.fan, first, end), report.fan.total());
    const double flown_percent = share(containedIn(report.flown_path, first, end), report.flown_path.total());
    const std::string label = end - first == 1 ? fmt::format("{}", first) : fmt::format("{} .. {}", first, end - 1);
    const std::string bar(static_cast<std::size_t>(fan_percent / kPercent * kBarWidth), '#');
    text.line("  {:<14}{:>8.2f}%{:>8.2f}%  {}", label, fan_percent, flown_percent, bar);
  }
}

void writeLatency(Text& text, std::string_view name, const std::vector<Duration>& times) {
  const auto at_ms = [&times](double fraction) { return 1e3 * toSeconds(percentile(times, fraction)); };
  text.line("  {:<22}{:>8}{:>11.4f}{:>11.4f}{:>11.4f}", name, times.size(), at_ms(0.5), at_ms(0.99), at_ms(1.0));
}

void writeLatencies(Text& text, const ReplayReport& report) {
  text.line("time [ms]{:>23}{:>11}{:>11}{:>11}", "count", "p50", "p99", "max");
  writeLatency(text, "index of a frame", report.build_times);
  writeLatency(text, "all points of a frame", report.query_times);
  writeLatency(text, "one point, on average", report.point_times);
  writeLatency(text, "a plan", report.plan_times);
}

}  // namespace

std::string summaryOf(const ReplayReport& report, const Configuration& configuration) {
  Text text;
  writeLog(text, report);
  writeSteps(text, report);
  writeInputs(text, report);
  writeStatuses(text, report);
  writeHistory(text, report);
  writePlans(text, report.plans);
  writeLatencies(text, report);
  for (const std::string& warning : warningsOf(report, configuration)) text.line("warning: {}", warning);
  return text.take();
}

}  // namespace nanomap
