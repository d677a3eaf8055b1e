#include "firmware_app/flight/surroundings.h"

#include <stdexcept>

#include "firmware_app/realtime/memory_lock.h"
#include "firmware_app/realtime/realtime_check.h"
#include "firmware_app/realtime/realtime_facts.h"

namespace nanomap {

Surroundings prepare(const Configuration& configuration, bool allow_no_realtime) {
  constexpr int kAnyRealtimePriority = 1;
  Surroundings surroundings;
  const int wanted = configuration.layout ? configuration.layout->highestPriority() : kAnyRealtimePriority;
  RealtimeFacts facts = gatherRealtimeFacts(wanted);
  surroundings.layout = configuration.layout.value_or(defaultLayout(facts.cores));
  checkLayout(surroundings.layout, facts.cores);
  if (!configuration.layout) facts = gatherRealtimeFacts(surroundings.layout.highestPriority());

  const auto findings = judgeRealtime(facts, {});
  if (!grantsRealtime(findings) && !allow_no_realtime) {
    throw std::runtime_error("this machine does not grant real time:\n" + toText(findings) +
                             "For the bench, --allow-no-realtime runs without.");
  }
  if (!findings.empty()) surroundings.remarks.push_back(toText(findings));
  if (const auto refused = lockMemory(); refused && !allow_no_realtime) {
    throw std::runtime_error("memory cannot be locked: " + refused.message());
  }
  return surroundings;
}

}  // namespace nanomap
