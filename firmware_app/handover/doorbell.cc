#include "firmware_app/handover/doorbell.h"

#include <cerrno>
#include <ctime>

namespace nanomap {
namespace {

timespec monotonicIn(Duration duration) {
  constexpr std::int64_t kSecond_ns = 1'000'000'000;
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const std::int64_t ns = now.tv_nsec + duration.count();
  return {now.tv_sec + ns / kSecond_ns, ns % kSecond_ns};
}

}  // namespace

Doorbell::Doorbell() { sem_init(&semaphore_, 0, 0); }
Doorbell::~Doorbell() { sem_destroy(&semaphore_); }

void Doorbell::ring() { sem_post(&semaphore_); }

bool Doorbell::wait(Duration at_most) {
  const timespec deadline = monotonicIn(at_most);
  while (sem_clockwait(&semaphore_, CLOCK_MONOTONIC, &deadline) != 0) {
    if (errno != EINTR) return false;
  }
  while (sem_trywait(&semaphore_) == 0) {
  }
  return true;
}

}  // namespace nanomap
