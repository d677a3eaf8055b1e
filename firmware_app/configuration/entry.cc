#include "firmware_app/configuration/entry.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <sstream>

namespace nanomap {
namespace {

std::optional<Value> listFrom(const toml::array& array) {
  std::vector<std::int64_t> integers;
  std::vector<double> numbers;
  for (const toml::node& element : array) {
    if (const auto* integer = element.as_integer()) {
      integers.push_back(integer->get());
      numbers.push_back(static_cast<double>(integer->get()));
    } else if (const auto* number = element.as_floating_point()) {
      numbers.push_back(number->get());
    } else {
      return std::nullopt;
    }
  }
  if (integers.size() == numbers.size()) return integers;
  return numbers;
}

std::optional<Value> valueFrom(const toml::node& node) {
  if (const auto* flag = node.as_boolean()) return flag->get();
  if (const auto* integer = node.as_integer()) return integer->get();
  if (const auto* number = node.as_floating_point()) return number->get();
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* array = node.as_array()) return listFrom(*array);
  return std::nullopt;
}

std::string textOf(const toml::node& node) {
  std::ostringstream out;
  node.visit([&out](const auto& typed) { out << typed; });
  return out.str();
}

void flatten(const toml::table& table, const std::string& prefix, const std::string& file,
             std::vector<Entry>& entries) {
  for (const auto& [name, node] : table) {
    const std::string key = prefix + std::string(name.str());
    const auto* inner = node.as_table();
    if (inner != nullptr && !inner->empty()) {
      flatten(*inner, key + ".", file, entries);
      continue;
    }
    entries.push_back({key, valueFrom(node), textOf(node), fmt::format("{}:{}", file, name.source().begin.line),
                       inner != nullptr || node.is_array_of_tables()});
  }
}

}  // namespace

std::vector<Entry> parseEntries(std::string_view toml_text, const std::string& file) {
  try {
    std::vector<Entry> entries;
    flatten(toml::parse(toml_text, file), "", file, entries);
    return entries;
  } catch (const toml::parse_error& error) {
    throw ConfigurationError(fmt::format("{}:{}: {}", file, error.source().begin.line, error.description()));
  }
}

Entry parseOverride(const std::string& assignment) {
  const std::size_t equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw ConfigurationError(fmt::format("--set {}: write it as section.key=value", assignment));
  }
  const std::string key = assignment.substr(0, equals);
  const std::string text = assignment.substr(equals + 1);
  const std::string origin = "--set";
  try {
    const toml::table table = toml::parse("value = " + text, origin);
    if (table.size() == 1) return {key, valueFrom(*table.get("value")), text, origin};
  } catch (const toml::parse_error&) {
    // Not TOML: a word without its quotes, which the key's own rule accepts or refuses.
  }
  return {key, text, text, origin};
}

}  // namespace nanomap
