#include "tools/replay/warnings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <numeric>

namespace nanomap {
namespace {

constexpr std::array kNeeded = {InputKind::kPose, InputKind::kDepth};

std::string channelsOfLog(const ReplayReport& report) {
  std::vector<std::string> names;
  for (const auto& [channel, events] : report.events_by_channel) names.push_back(channel);
  return fmt::format("channels in this log: {}", fmt::join(names, ", "));
}

/// Where the configuration says which channel carries a kind.
std::string_view channelKey(InputKind kind) {
  switch (kind) {
    case InputKind::kPose:
      return "lcm.pose_channel";
    case InputKind::kCorrection:
      return "lcm.correction_channel";
    case InputKind::kCamera:
      return "lcm.camera_channel";
    case InputKind::kGoal:
      return "lcm.goal_channel";
    case InputKind::kDepth:
      break;
  }
  return "lcm.depth_channel";
}

std::string nothingFound(const ReplayReport& report, const Configuration& configuration, InputKind kind) {
  const std::string& channel = channelOf(configuration.lcm, kind);
  const bool in_log = report.events_by_channel.contains(channel);
  return fmt::format("no {} found on channel {}{}; {} ({} sets the channel)", toString(kind), channel,
                     in_log ? " in the replayed part" : "", channelsOfLog(report), channelKey(kind));
}

template <class Counters>
std::uint64_t sum(const Counters& counters) {
  return std::accumulate(counters.begin(), counters.end(), std::uint64_t{0});
}

template <class Enum, class Counters>
std::uint64_t of(const Counters& counters, Enum value) {
  return counters[static_cast<std::size_t>(value)];
}

void warnOfFaultyMessages(const ReplayReport& report, const Configuration& configuration,
                          std::vector<std::string>& warnings) {
  for (std::size_t i = 0; i < kInputKindCount; ++i) {
    const auto kind = static_cast<InputKind>(i);
    const std::uint64_t wrong_type = of(report.pipeline.decode_faults[i], DecodeFault::kWrongType);
    const std::uint64_t faults = sum(report.pipeline.decode_faults[i]) + sum(report.pipeline.convert_faults[i]);
    const std::string& channel = channelOf(configuration.lcm, kind);
    if (wrong_type > 0) {
      warnings.push_back(
          fmt::format("{} of {} messages on channel {} are of no type known for {}: is {} the right channel?",
                      wrong_type, report.pipeline.messages[i], channel, toString(kind), channelKey(kind)));
    }
    if (faults > wrong_type) {
      warnings.push_back(fmt::format("{} of {} messages on channel {} are damaged and were left out",
                                     faults - wrong_type, report.pipeline.messages[i], channel));
    }
  }
}

void warnOfCamera(const ReplayReport& report, std::vector<std::string>& warnings) {
  const PipelineCounters& counters = report.pipeline;
  if (!report.camera_changes.empty()) {
    warnings.push_back(
        fmt::format("the camera model changed {} times, first after {:.3f} s: frames from then on use the new one",
                    report.camera_changes.size(), toSeconds(report.camera_changes.front())));
  }
  if (of(counters.cameras, CameraVerdict::kInvalid) > 0) {
    warnings.push_back(fmt::format("{} camera models were refused, the last because of {}",
                                   of(counters.cameras, CameraVerdict::kInvalid), report.last_camera_fault));
  }
  if (of(counters.cameras, CameraVerdict::kOverridden) > 0) {
    warnings.push_back("the log's camera models were not used: the configuration has [camera]");
  }
  if (const auto early = of(counters.camera_faults, CameraFault::kNoCamera); early > 0 && report.has_camera) {
    warnings.push_back(fmt::format(
        "{} depth frames came before the first camera model and were dropped: [camera] in the configuration keeps them",
        early));
  }
  const auto others =
      of(counters.camera_faults, CameraFault::kOtherCamera) + of(counters.cameras, CameraVerdict::kOtherCamera);
  if (others > 0) {
    warnings.push_back(fmt::format("{} messages are of another camera than the first: one camera is replayed", others));
  }
  if (const auto units = of(counters.image_faults, ImageFault::kUnitMismatch); units > 0) {
    warnings.push_back(fmt::format(
        "{} depth frames have another depth unit than the camera model and were dropped: correct camera.depth_unit_m",
        units));
  }
  if (const auto sizes = of(counters.image_faults, ImageFault::kSizeMismatch); sizes > 0) {
    warnings.push_back(fmt::format(
        "{} depth frames have another size than the camera model and were dropped: correct camera.width_px, height_px",
        sizes));
  }
}

void warnOfViews(const ReplayReport& report, std::vector<std::string>& warnings) {
  const ChainCounters& chain = report.chain;
  if (const auto future = of(chain.views_dropped, ViewDrop::kFromFuture); future > 0) {
    warnings.push_back(fmt::format(
        "{} depth frames are stamped far ahead of the poses and were dropped: are both on the same clock?", future));
  }
  if (const auto early = of(chain.views_dropped, ViewDrop::kNoPose); chain.views_inserted == 0 && early > 0) {
    warnings.push_back(fmt::format("{} depth frames are older than every pose: are both on the same clock?", early));
  }
  if (const auto gaps = of(chain.views_dropped, ViewDrop::kPoseGap); gaps > 0) {
    warnings.push_back(fmt::format(
        "{} depth frames fell into gaps of the pose stream and were dropped: history.max_pose_gap_s sets the limit",
        gaps));
  }
}

}  // namespace

std::vector<std::string> warningsOf(const ReplayReport& report, const Configuration& configuration) {
  std::vector<std::string> warnings;
  if (!report.damage.empty()) {
    const auto bytes = std::accumulate(report.damage.begin(), report.damage.end(), std::uint64_t{0},
                                       [](std::uint64_t total, const LogDamage& d) { return total + d.size_bytes; });
    warnings.push_back(
        fmt::format("the log is damaged in {} places; {} bytes were skipped", report.damage.size(), bytes));
  }
  if (report.steps && !report.steps->losses.empty()) {
    warnings.push_back(
        fmt::format("from {:.3f} s on decisions may not be those of the flight: the recording has losses",
                    toSeconds(report.steps->losses.front().at - report.log_start)));
  }
  for (const InputKind kind : kNeeded) {
    if (of(report.pipeline.messages, kind) == 0) warnings.push_back(nothingFound(report, configuration, kind));
  }
  warnOfFaultyMessages(report, configuration, warnings);
  warnOfCamera(report, warnings);
  warnOfViews(report, warnings);
  const DriftModel& drift = configuration.chain.drift;
  if (drift.horizontal_std_m == 0.0 && drift.vertical_std_m == 0.0 && !drift.use_increments) {
    warnings.push_back("the estimator is taken for perfect: drift.horizontal_std_m and drift.vertical_std_m are 0");
  }
  return warnings;
}

std::string explainMissingCamera(const ReplayReport& report, const Configuration& configuration) {
  std::string reason = of(report.pipeline.messages, InputKind::kCamera) == 0
                           ? nothingFound(report, configuration, InputKind::kCamera)
                           : fmt::format("no usable camera model on channel {}", configuration.lcm.camera_channel);
  if (!report.last_camera_fault.empty()) reason += " (" + report.last_camera_fault + ")";
  return reason + ". Give the camera in the configuration's [camera]: --help-config shows how.";
}

}  // namespace nanomap
