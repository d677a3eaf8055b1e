#include "firmware_app/supervision/progress.h"

namespace nanomap {

std::string_view toString(Activity activity) {
  switch (activity) {
    case Activity::kStarting:
      return "starting";
    case Activity::kWorking:
      return "working";
    case Activity::kWaiting:
      return "waiting";
    case Activity::kEnded:
      return "ended";
  }
  return "?";
}

void Progress::tell(Activity activity) noexcept {
  const std::uint64_t times_told = (told_.load(std::memory_order_relaxed) >> kActivityBits) + 1;
  told_.store((times_told << kActivityBits) | static_cast<std::uint64_t>(activity), std::memory_order_release);
}

Progress::Reading Progress::read() const noexcept {
  const std::uint64_t told = told_.load(std::memory_order_acquire);
  constexpr std::uint64_t kActivityMask = (1U << kActivityBits) - 1U;
  return {.activity = static_cast<Activity>(told & kActivityMask), .times_told = told >> kActivityBits};
}

}  // namespace nanomap
