#include "firmware_app/safety/fault.h"

namespace nanomap {

std::string_view toString(Fault fault) {
  switch (fault) {
    case Fault::kEnding:
      return "leave to go on (it was told to end)";
    case Fault::kHeldUp:
      return "time to run (held up)";
    case Fault::kStalled:
      return "an answer of a thread";
    case Fault::kCamera:
      return "camera model";
    case Fault::kDepth:
      return "depth images";
    case Fault::kDepthStuck:
      return "depth images that change";
    case Fault::kPose:
      return "poses";
    case Fault::kClock:
      return "stamps of our clock";
    case Fault::kPlan:
      return "a plan";
    case Fault::kUnsent:
      return "a way out for setpoints";
    case Fault::kAutopilot:
      return "autopilot";
    case Fault::kAlignment:
      return "alignment";
    case Fault::kLive:
      return "a simulated autopilot (a log is never flown)";
  }
  return "?";
}

std::string FaultSet::words() const {
  std::string words;
  for (std::size_t i = 0; i < kFaultCount; ++i) {
    if (!bits_.test(i)) continue;
    if (!words.empty()) words += ", ";
    words += toString(static_cast<Fault>(i));
  }
  return words;
}

}  // namespace nanomap
