#include "firmware_app/supervision/end_signals.h"

#include <pthread.h>

#include <ctime>

namespace nanomap {

EndSignals::EndSignals() {
  sigemptyset(&set_);
  sigaddset(&set_, SIGINT);
  sigaddset(&set_, SIGTERM);
  pthread_sigmask(SIG_BLOCK, &set_, nullptr);
}

bool EndSignals::wait(Duration at_most) const {
  const auto whole_s = std::chrono::duration_cast<std::chrono::seconds>(at_most);
  const timespec timeout{whole_s.count(), (at_most - whole_s).count()};
  return sigtimedwait(&set_, nullptr, &timeout) > 0;
}

}  // namespace nanomap
