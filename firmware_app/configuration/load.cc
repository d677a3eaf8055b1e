#include "firmware_app/configuration/load.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <map>

#include "firmware_app/configuration/sections.h"
#include "firmware_app/configuration/suggestion.h"

namespace nanomap {
namespace {

using EntriesByKey = std::map<std::string, Entry>;

std::string unknownKey(const Entry& entry) {
  const std::string section_name = entry.key.substr(0, entry.key.find('.'));
  std::vector<std::string> section_names;
  std::vector<std::string> key_names;
  std::vector<std::string> keys_of_section;
  for (const Section& section : sections()) {
    section_names.push_back(section.name);
    for (const Key& key : section.keys) {
      key_names.push_back(qualifiedName(section, key));
      if (section.name == section_name) keys_of_section.push_back(key.name);
    }
  }
  const bool whole_section = entry.is_table || entry.key.find('.') == std::string::npos;
  const std::string nearest = nearestWord(entry.key, whole_section ? section_names : key_names);
  std::string hint;
  if (!nearest.empty()) {
    hint = fmt::format("did you mean '{}'?", nearest);
  } else if (!keys_of_section.empty()) {
    hint = fmt::format("[{}] has {}", section_name, fmt::join(keys_of_section, ", "));
  } else {
    hint = fmt::format("the sections are {}", fmt::join(section_names, ", "));
  }
  return fmt::format("{}: unknown {} '{}': {}", entry.origin, entry.is_table ? "section" : "key", entry.key, hint);
}

bool isSection(const std::string& name) {
  return std::any_of(sections().begin(), sections().end(), [&](const Section& s) { return s.name == name; });
}

/// Collects faults, so that a file is mended in one go.
class Reader {
 public:
  Configuration read(const EntriesByKey& entries) {
    for (const auto& [name, entry] : entries) checkName(entry);
    for (const Section& section : sections()) readSection(section, entries);
    checkCamera();
    checkPlanner();
    checkChannels();
    checkRecorder();
    checkOdometry();
    checkAlignment();
    checkFeedforward();
    if (!faults_.empty()) throw ConfigurationError(fmt::format("{}", fmt::join(faults_, "\n")));
    return configuration_;
  }

 private:
  void checkName(const Entry& entry) {
    if (isSection(entry.key)) {
      if (!entry.is_table) {
        faults_.push_back(fmt::format("{}: '{}' is a section: write [{}] and its keys below it, not {} = {}",
                                      entry.origin, entry.key, entry.key, entry.key, entry.text));
      }
    } else if (!findKey(entry.key)) {
      faults_.push_back(unknownKey(entry));
    }
  }

  void readSection(const Section& section, const EntriesByKey& entries) {
    const auto given = [&](const Key& key) { return entries.find(qualifiedName(section, key)); };
    const auto first = std::find_if(section.keys.begin(), section.keys.end(),
                                    [&](const Key& key) { return given(key) != entries.end(); });
    const auto header = entries.find(section.name);
    if (first == section.keys.end() && header == entries.end()) return;
    const std::string& origin = first == section.keys.end() ? header->second.origin : given(*first)->second.origin;
    if (section.optional) section.optional->create(configuration_);

    const Key* previous = nullptr;
    for (const Key& key : section.keys) {
      const auto entry = given(key);
      if (entry != entries.end()) {
        readKey(key, entry->second);
        const bool both = key.presence == Presence::kAlternative && given(*previous) != entries.end();
        if (both) {
          faults_.push_back(fmt::format("{}: '{}' and '{}' say the same thing: keep one", entry->second.origin,
                                        entry->first, given(*previous)->first));
        }
      } else if (key.presence == Presence::kRequired) {
        faults_.push_back(fmt::format("{}: [{}] needs '{}', {}", origin, section.name, qualifiedName(section, key),
                                      describe(key.rule)));
      }
      previous = &key;
    }
  }

  void readKey(const Key& key, const Entry& entry) {
    const auto value = entry.value ? accept(key.rule, *entry.value) : std::nullopt;
    if (value) {
      key.write(configuration_, *value);
    } else {
      faults_.push_back(
          fmt::format("{}: {} = {}: must be {}", entry.origin, entry.key, entry.text, describe(key.rule)));
    }
  }

  /// What only the whole of a camera shows: the order of its ranges, its rotation's norm, an invertible distortion.
  void checkCamera() {
    if (!configuration_.camera || !faults_.empty()) return;
    try {
      (void)CameraModel(*configuration_.camera);
    } catch (const std::invalid_argument& error) {
      faults_.push_back(fmt::format("[camera]: {}", error.what()));
    }
  }

  /// What only several of its values together show, such as the order of two limits.
  void checkPlanner() {
    if (!faults_.empty()) return;
    try {
      check(configuration_.planner);
      check(configuration_.safety);
    } catch (const std::invalid_argument& error) {
      faults_.emplace_back(error.what());
    }
  }

  /// A message is told by its channel first.
  void checkChannels() {
    const LcmParameters& lcm = configuration_.lcm;
    const std::array<std::string_view, 13> channels = {
        lcm.depth_channel,   lcm.pose_channel,      lcm.correction_channel, lcm.camera_channel,    lcm.goal_channel,
        lcm.answers_channel, lcm.decisions_channel, lcm.steps_channel,      lcm.setpoints_channel, lcm.state_channel,
        lcm.health_channel,  lcm.lost_channel,      kConfigurationChannel};
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
      if (std::find(channels.begin(), channel, *channel) != channel) {
        faults_.push_back(fmt::format("[lcm]: two channels are named '{}': each needs a name of its own", *channel));
      }
    }
  }

  void checkRecorder() {
    const RecorderParameters& recorder = configuration_.recorder;
    if (recorder.total_mb < 2 * recorder.segment_mb) {
      faults_.push_back(fmt::format("[recorder]: total_mb = {} must be at least twice segment_mb = {}",
                                    recorder.total_mb, recorder.segment_mb));
    }
  }

  void checkOdometry() {
    const OdometrySpread& odometry = configuration_.mavlink.odometry;
    if ((odometry.position_sd_m > 0.0) != (odometry.attitude_sd_rad > 0.0)) {
      faults_.emplace_back(
          "[mavlink]: odometry_position_sd_m and odometry_attitude_sd_rad must be above 0 both, or neither: MAVLink "
          "knows "
          "no half of a covariance");
    }
  }

  /// A stream that is always silent by its own rate says nothing about where the autopilot is.
  void checkAlignment() {
    constexpr double kLeastPoses = 4.0;
    const MavlinkParameters& mavlink = configuration_.mavlink;
    const double poses = toSeconds(mavlink.alignment.max_age) * mavlink.link.pose_rate_hz;
    if (poses < kLeastPoses) {
      faults_.push_back(fmt::format("[alignment]: max_age_s = {:g} must be at least {:g} / mavlink.pose_rate_hz = {:g}",
                                    toSeconds(mavlink.alignment.max_age), kLeastPoses,
                                    kLeastPoses / mavlink.link.pose_rate_hz));
    }
  }

  /// What is flown of a plan leads on to its brake.
  void checkFeedforward() {
    const Feedforward& feedforward = configuration_.mavlink.feedforward;
    const Duration least = configuration_.safety.max_plan_age + feedforward.setpoint_lead + feedforward.tilt_lag;
    const double brake_after_s = configuration_.planner.brake_after_s;
    if (fromSeconds(brake_after_s) < least) {
      faults_.push_back(fmt::format(
          "[planner]: brake_after_s = {:g} must be at least {:g}, safety.max_plan_age_s with mavlink.setpoint_lead_s "
          "and tilt_lag_s: else plans are told with the acceleration of their brakes",
          brake_after_s, toSeconds(least)));
    }
  }

  Configuration configuration_;
  std::vector<std::string> faults_;
};

}  // namespace

Configuration parseConfiguration(std::string_view toml_text, const std::string& file,
                                 const std::vector<std::string>& overrides) {
  EntriesByKey entries;
  for (Entry& entry : parseEntries(toml_text, file)) entries.insert_or_assign(entry.key, entry);
  for (const std::string& assignment : overrides) {
    Entry entry = parseOverride(assignment);
    entries.insert_or_assign(entry.key, std::move(entry));
  }
  return Reader().read(entries);
}

Configuration loadConfiguration(const std::filesystem::path& path, const std::vector<std::string>& overrides) {
  if (path.empty()) return parseConfiguration("", "", overrides);
  const auto unreadable = [&path] {
    return ConfigurationError(fmt::format("{}: cannot be read: check the path and its permissions", path.string()));
  };
  if (std::filesystem::is_directory(path)) throw unreadable();
  std::ifstream in(path, std::ios::binary);
  if (!in) throw unreadable();
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return parseConfiguration(text, path.string(), overrides);
}

}  // namespace nanomap
