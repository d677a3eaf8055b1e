#include "tools/replay/recorded_configuration.h"

#include <fmt/format.h>

#include <optional>
#include <utility>
#include <variant>

#include "drivers/lcm/decode.h"
#include "firmware_app/configuration/load.h"
#include "nanomap/text_t.hpp"

namespace nanomap {
namespace {

/// The first configuration in the log, as TOML; empty if it holds none.
std::optional<std::string> recordedToml(LogReader& log) {
  std::vector<std::uint8_t> message;
  for (const LogEvent& event : log.events()) {
    if (log.channelOf(event) != kConfigurationChannel) continue;
    log.read(event, message);
    Decoded<text_t> decoded = decode<text_t>(message);
    if (auto* text = std::get_if<text_t>(&decoded)) return std::move(text->text);
  }
  return std::nullopt;
}

std::string withOverrides(std::string origin, std::size_t overrides) {
  return overrides == 0 ? origin : fmt::format("{}, with {} set otherwise", origin, overrides);
}

}  // namespace

ChosenConfiguration chooseConfiguration(LogReader& log, const std::filesystem::path& file,
                                        const std::vector<std::string>& overrides) {
  if (!file.empty()) return {loadConfiguration(file, overrides), withOverrides(file.string(), overrides.size())};
  if (const auto toml = recordedToml(log)) {
    return {parseConfiguration(*toml, "the log's configuration (--config replaces it)", overrides),
            withOverrides("as recorded in the log", overrides.size())};
  }
  return {loadConfiguration({}, overrides), withOverrides("defaults", overrides.size())};
}

}  // namespace nanomap
