#pragma once

#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "firmware_app/configuration/rule.h"

namespace nanomap {

/// Everything that is wrong with a configuration, one line a fault.
class ConfigurationError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One assignment, as it was written and before any check.
struct Entry {
  std::string key;             ///< "history.views"
  std::optional<Value> value;  ///< empty: of no type that a configuration uses
  std::string text;            ///< the value as written, for messages
  std::string origin;          ///< "nanomap.toml:12" or "--set"
  bool is_table = false;       ///< a table without keys, or an array of tables
};

/// The assignments of a TOML text, in the order of their keys.
/// @throws ConfigurationError with file and line if it is not TOML
[[nodiscard]] std::vector<Entry> parseEntries(std::string_view toml_text, const std::string& file);

/// The assignment `key=value` of a command line; quotes around a text may be left out.
/// @throws ConfigurationError if it has no '=' or the value is not TOML
[[nodiscard]] Entry parseOverride(const std::string& assignment);

}  // namespace nanomap
