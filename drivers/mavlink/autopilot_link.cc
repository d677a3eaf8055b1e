#include "drivers/mavlink/autopilot_link.h"

namespace nanomap {

std::string_view toString(SendResult result) {
  switch (result) {
    case SendResult::kSent:
      return "sent";
    case SendResult::kNoAutopilot:
      return "no autopilot";
    case SendResult::kNoClock:
      return "the autopilot's time is not known";
    case SendResult::kNotFinite:
      return "not finite";
    case SendResult::kRefused:
      return "refused by MAVSDK";
  }
  return "?";
}

}  // namespace nanomap
