#include <string>

#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

/// The two keys of a thread, both wanted once the section is there: half a layout would be a guess.
void addThread(std::vector<Key>& keys, RealtimeThread thread) {
  const std::string name(toString(thread));
  Key core = integerKey(
      name + "_core", "Core that the " + name + " thread runs on.",
      {0, 1023}, [thread](auto& c) -> auto& { return (*c.layout)[thread].core; });
  Key priority = integerKey(
      name + "_priority", "Its SCHED_FIFO priority: higher goes first, below those of interrupts.",
      {1, kInterruptPriority - 1}, [thread](auto& c) -> auto& { return (*c.layout)[thread].priority; });
  core.presence = Presence::kRequired;
  priority.presence = Presence::kRequired;
  keys.push_back(std::move(core));
  keys.push_back(std::move(priority));
}

}  // namespace

Section realtimeSection() {
  Section section;
  section.name = "realtime";
  section.help =
      "Where the real-time threads run. Without this section the machine's cores decide; nanomap-flight says how.";
  for (std::size_t i = 0; i < kRealtimeThreadCount; ++i) addThread(section.keys, static_cast<RealtimeThread>(i));
  section.optional = Section::Optional{[](const Configuration& c) { return c.layout.has_value(); },
                                       [](Configuration& c) { c.layout.emplace(); },
                                       [](Configuration& c) {
                                         c.layout = defaultLayout(std::vector<int>{0, 1, 2, 3});
                                       }};
  return section;
}

}  // namespace nanomap
