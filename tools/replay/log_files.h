#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace nanomap {

/// The files that arguments of a command line stand for: a folder for the parts of the latest flight recorded in it, in
/// their order, anything else for itself.
/// @throws std::runtime_error naming a folder without recordings
[[nodiscard]] std::vector<std::filesystem::path> logFiles(const std::vector<std::string>& arguments);

}  // namespace nanomap
