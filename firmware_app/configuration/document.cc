#include "firmware_app/configuration/document.h"

#include <fmt/format.h>

#include <sstream>

#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

std::string commented(const std::string& text) {
  std::string out;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) out += "# " + line + "\n";
  return out;
}

/// @param active    the section is there; else its keys are an example
/// @param defaults  what the values are compared with
std::string keyText(const Key& key, const Configuration& shown, const Configuration& defaults, bool active) {
  const std::string value = toToml(key.read(shown));
  const std::string initial = toToml(key.read(defaults));
  std::string allowed = describe(key.rule);
  std::string remark;
  if (key.presence == Presence::kRequired) allowed += "; required";
  if (key.presence == Presence::kDefaulted && value != initial) remark = "  # default " + initial;
  const bool effective = active && key.presence != Presence::kAlternative;
  return commented(key.help) + commented("(" + allowed + ")") +
         fmt::format("{}{} = {}{}\n", effective ? "" : "#", key.name, value, remark);
}

}  // namespace

std::string annotatedToml(const Configuration& configuration) {
  std::string out =
      "# NanoMap configuration (TOML). Every key may be left out: it then has its default. Units end the names.\n";
  for (const Section& section : sections()) {
    Configuration shown = configuration;
    Configuration defaults;
    const bool active = !section.optional || section.optional->present(configuration);
    if (section.optional) section.optional->create(defaults);
    if (!active) section.optional->fill_example(shown);
    out += fmt::format("\n{}{}[{}]\n", commented(section.help), active ? "" : "#", section.name);
    for (const Key& key : section.keys) out += "\n" + keyText(key, shown, defaults, active);
  }
  return out;
}

}  // namespace nanomap
