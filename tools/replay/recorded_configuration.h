#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"

namespace nanomap {

struct ChosenConfiguration {
  Configuration configuration;
  std::string origin;  ///< in words: where it is from
};

/// The given file's or, without one, that which the log was recorded with or, without that, the defaults; and on top of
/// it the overrides.
/// @param file       empty: none
/// @param overrides  as of loadConfiguration()
/// @throws ConfigurationError as loadConfiguration(); LogError if the log cannot be read
[[nodiscard]] ChosenConfiguration chooseConfiguration(LogReader& log, const std::filesystem::path& file,
                                                      const std::vector<std::string>& overrides);

}  // namespace nanomap
