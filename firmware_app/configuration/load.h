#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_app/configuration/configuration.h"
#include "firmware_app/configuration/entry.h"

namespace nanomap {

/// The configuration of a TOML text; what it does not mention keeps its default.
/// @param file       the text's name in messages
/// @param overrides  "section.key=value", as given on a command line: they win over the text, under the same checks
/// @throws ConfigurationError that lists every fault with file, line, key, value and what is allowed; an unknown key
///         with the known one it most resembles
[[nodiscard]] Configuration parseConfiguration(std::string_view toml_text, const std::string& file,
                                               const std::vector<std::string>& overrides = {});

/// The same for a file; an empty path stands for an empty file: defaults and overrides only.
/// @throws ConfigurationError also if the file cannot be read
[[nodiscard]] Configuration loadConfiguration(const std::filesystem::path& path,
                                              const std::vector<std::string>& overrides = {});

}  // namespace nanomap
