#include "firmware_app/flight/worker.h"

#include <utility>

#include "firmware_app/realtime/thread_allocations.h"

namespace nanomap {

Worker::Worker(const ThreadSettings& settings, std::function<void()> wait, std::function<void()> work)
    : settings_(settings),
      wait_(std::move(wait)),
      work_(std::move(work)),
      thread_(std::make_unique<StageThread>(settings, [this](const std::stop_token& stop) { run(stop); })) {}

void Worker::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    progress_.waiting();
    wait_();
    progress_.working();
    work_();
    usage_.sample();
    allocations_.store(allocationsOfThisThread(), std::memory_order_relaxed);
  }
  progress_.ended();
}

}  // namespace nanomap
