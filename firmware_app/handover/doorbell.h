#pragma once

#include <semaphore.h>

#include "core/time.h"

namespace nanomap {

/// What a thread sleeps on until another one has something for it, in whichever queue. Rings that come while it is
/// awake are not lost, and add up to one.
/// Threads: any ring, which neither waits nor allocates; one waits.
class Doorbell {
 public:
  Doorbell();
  ~Doorbell();
  Doorbell(const Doorbell&) = delete;
  Doorbell& operator=(const Doorbell&) = delete;

  void ring();

  /// Until it rings, and at most this long. False if it did not ring.
  bool wait(Duration at_most);

 private:
  sem_t semaphore_;
};

}  // namespace nanomap
