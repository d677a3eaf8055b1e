#include "core/status.h"

namespace nanomap {

std::string_view toString(Status status) {
  switch (status) {
    case Status::kFree:
      return "free";
    case Status::kPartial:
      return "partial";
    case Status::kOpen:
      return "open";
    case Status::kHole:
      return "hole";
    case Status::kOccluded:
      return "occluded";
    case Status::kBeyondRange:
      return "beyond range";
    case Status::kOutsideFov:
      return "outside fov";
    case Status::kBehind:
      return "behind";
    case Status::kEmpty:
      return "empty";
  }
  return "?";
}

}  // namespace nanomap
