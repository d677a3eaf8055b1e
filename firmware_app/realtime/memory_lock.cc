#include "firmware_app/realtime/memory_lock.h"

#include <malloc.h>
#include <sys/mman.h>

#include <cerrno>

namespace nanomap {

std::error_code lockMemory() {
  if (!kLocksMemory) return {};
  constexpr int kNever = -1;
  constexpr int kNone = 0;
  // NOLINTBEGIN(concurrency-mt-unsafe): at start-up there is one thread
  mallopt(M_TRIM_THRESHOLD, kNever);
  mallopt(M_MMAP_MAX, kNone);  // what is mapped for one allocation is given back when that is freed
  // NOLINTEND(concurrency-mt-unsafe)
  if (mlockall(MCL_CURRENT | MCL_FUTURE) == 0) return {};
  return {errno, std::generic_category()};
}

}  // namespace nanomap
