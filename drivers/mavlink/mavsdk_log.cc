#include "drivers/mavlink/mavsdk_log.h"

#include <algorithm>
#include <utility>

#include "drivers/mavlink/cmavsdk.h"

namespace nanomap {

MavsdkLog::MavsdkLog(Listener listener) : listener_(std::move(listener)) {
  mavsdk_log_subscribe(
      [](int level, const char* message, const char* /*file*/, int /*line*/, void* self) {
        const int known = std::clamp(level, static_cast<int>(Level::kDebug), static_cast<int>(Level::kError));
        static_cast<MavsdkLog*>(self)->listener_(static_cast<Level>(known), message);
        return true;
      },
      this);
}

MavsdkLog::~MavsdkLog() { mavsdk_log_unsubscribe(); }

}  // namespace nanomap
