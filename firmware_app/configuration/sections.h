#pragma once

#include <string>
#include <vector>

#include "firmware_app/configuration/key.h"

namespace nanomap {

/// Every section of the configuration file, in the file's order. A new part of the process adds its values to
/// Configuration and its section here; parsing, checks and documentation follow.
[[nodiscard]] const std::vector<Section>& sections();

/// A key with its section.
struct QualifiedKey {
  const Section* section = nullptr;
  const Key* key = nullptr;
};

/// "history.views"
[[nodiscard]] std::string qualifiedName(const Section& section, const Key& key);

/// Empty if there is no key of that name.
[[nodiscard]] std::optional<QualifiedKey> findKey(std::string_view qualified_name);

/// Makes [camera], which may be missing: the log or the network says what the camera is, then.
[[nodiscard]] Section cameraSection();

/// Make [planner] and what belongs to it, named as planner/planner_parameters.h names the parts.
[[nodiscard]] std::vector<Section> plannerSections();

/// Makes [realtime], which may be missing: the machine decides, then.
[[nodiscard]] Section realtimeSection();

/// Make [mavlink], [alignment], [safety] and [recorder]: what only a flight needs.
[[nodiscard]] std::vector<Section> flightSections();

}  // namespace nanomap
