#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "firmware_app/configuration/document.h"
#include "firmware_app/configuration/load.h"
#include "tests/fuzz/require.h"

/// The bytes are a configuration file, or an override. What is accepted must be written and read back without a change.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  const std::string text(data, data + size);
  try {
    const std::string written = annotatedToml(parseConfiguration(text, "fuzz"));
    fuzz::require(annotatedToml(parseConfiguration(written, "written")) == written);
  } catch (const ConfigurationError&) {  // it lists what is wrong
  }
  try {
    static_cast<void>(parseConfiguration("", "", {text}));
  } catch (const ConfigurationError&) {
  }
  return 0;
}
