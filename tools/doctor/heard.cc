#include "tools/doctor/heard.h"

#include <algorithm>

namespace nanomap::doctor {

const HeardChannel* Heard::channel(const std::string& name) const {
  const auto found = std::ranges::find(channels, name, &HeardChannel::name);
  return found == channels.end() ? nullptr : &*found;
}

}  // namespace nanomap::doctor
