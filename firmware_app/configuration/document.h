#pragma once

#include <string>

#include "firmware_app/configuration/configuration.h"

namespace nanomap {

/// `configuration` as a TOML file with every key explained: unit, range, and the default where the value is another.
/// Reading it back gives the same configuration. A section that is not there is shown commented out, with an example.
[[nodiscard]] std::string annotatedToml(const Configuration& configuration);

}  // namespace nanomap
