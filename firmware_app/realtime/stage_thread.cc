#include "firmware_app/realtime/stage_thread.h"

#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <latch>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "firmware_app/realtime/realtime_check.h"
#include "firmware_app/realtime/thread_stack.h"

namespace nanomap {
namespace {

constexpr std::size_t kMaxNameBytes = 15;  // pthread_setname_np(3)
constexpr int kSuccess = 0;

std::string messageOf(int error) { return std::generic_category().message(error); }

void checkSettings(const ThreadSettings& settings) {
  if (settings.name.empty() || settings.name.size() > kMaxNameBytes) {
    throw std::invalid_argument("the name '" + settings.name + "' of a thread must have 1 to " +
                                std::to_string(kMaxNameBytes) + " bytes");
  }
  if (settings.stack_bytes < kMinStackBytes) {
    throw std::invalid_argument("the stack of thread " + settings.name + " has " +
                                std::to_string(settings.stack_bytes) + " bytes; it needs " +
                                std::to_string(kMinStackBytes) + " or more");
  }
}

/// Signals for others. Those that a fault raises in the thread itself must reach it.
sigset_t foreignSignals() {
  sigset_t signals;
  sigfillset(&signals);
  for (const int own : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGTRAP, SIGSYS, SIGABRT, SIGPROF}) sigdelset(&signals, own);
  return signals;
}

/// Puts the calling thread to its place, as far as the machine lets it. @return what it refused
std::optional<std::string> takePlace(const ThreadPlace& place) {
  std::optional<std::string> refusal;
  cpu_set_t core;
  CPU_ZERO(&core);
  CPU_SET(static_cast<std::size_t>(place.core), &core);
  if (const int error = pthread_setaffinity_np(pthread_self(), sizeof core, &core); error != kSuccess) {
    refusal = "core " + std::to_string(place.core) + " (" + messageOf(error) + ")";
  }
  sched_param parameters{};
  parameters.sched_priority = place.priority;
  if (const int error = pthread_setschedparam(pthread_self(), SCHED_FIFO, &parameters); error != kSuccess) {
    refusal = (refusal ? *refusal + "; " : "") + "SCHED_FIFO priority " + std::to_string(place.priority) + " (" +
              messageOf(error) + ")";
  }
  return refusal;
}

/// The cores of the main thread, which is never pinned.
cpu_set_t coresOfProcess() {
  cpu_set_t cores;
  CPU_ZERO(&cores);
  if (sched_getaffinity(getpid(), sizeof cores, &cores) != 0) {
    throw std::system_error(errno, std::generic_category(), "the cores of the process");
  }
  return cores;
}

/// What a thread is created with. Nothing of it comes from the thread that makes it: one made by a real-time thread is
/// a plain one all the same.
class Attributes {
 public:
  explicit Attributes(const ThreadStack& stack) {
    check(pthread_attr_init(&attributes_));
    const sigset_t blocked = foreignSignals();
    check(pthread_attr_setsigmask_np(&attributes_, &blocked));
    const cpu_set_t cores = coresOfProcess();
    check(pthread_attr_setaffinity_np(&attributes_, sizeof cores, &cores));
    check(pthread_attr_setinheritsched(&attributes_, PTHREAD_EXPLICIT_SCHED));
    check(pthread_attr_setschedpolicy(&attributes_, SCHED_OTHER));
    const sched_param no_priority{};  // unset it would be that of the maker
    check(pthread_attr_setschedparam(&attributes_, &no_priority));
    check(pthread_attr_setstack(&attributes_, stack.lowest(), stack.bytes()));
  }
  ~Attributes() { pthread_attr_destroy(&attributes_); }
  Attributes(const Attributes&) = delete;
  Attributes& operator=(const Attributes&) = delete;

  [[nodiscard]] const pthread_attr_t* get() const { return &attributes_; }

 private:
  static void check(int error) {
    if (error != kSuccess) throw std::system_error(error, std::generic_category(), "attributes of a thread");
  }

  pthread_attr_t attributes_{};
};

}  // namespace

/// What the thread and its maker share, at one address for as long as either needs it.
struct StageThread::Running {
  Running(const ThreadSettings& wanted, Body to_run)
      : settings(wanted), body(std::move(to_run)), stack(wanted.stack_bytes) {}

  static void* enter(void* self) noexcept {
    static_cast<Running*>(self)->run();
    return nullptr;
  }

  void run() {
    pthread_setname_np(pthread_self(), settings.name.c_str());
    if (settings.place) refusal = takePlace(*settings.place);
    const bool granted = !refusal || !settings.demand_realtime;
    set_up.count_down();
    if (granted) body(stop.get_token());
  }

  ThreadSettings settings;
  Body body;
  ThreadStack stack;
  std::stop_source stop;
  std::latch set_up{1};
  std::optional<std::string> refusal;  ///< the thread's until set_up, then constant
};

StageThread::StageThread(const ThreadSettings& settings, Body body) {
  checkSettings(settings);
  running_ = std::make_unique<Running>(settings, std::move(body));
  const Attributes attributes(running_->stack);
  if (const int error = pthread_create(&thread_, attributes.get(), &Running::enter, running_.get());
      error != kSuccess) {
    throw std::runtime_error("thread " + settings.name + " cannot be started: " + messageOf(error));
  }
  running_->set_up.wait();
  if (!running_->refusal || !settings.demand_realtime) return;
  pthread_join(thread_, nullptr);
  throw std::runtime_error("thread " + settings.name + " is refused " + *running_->refusal +
                           ". Choose a core that the process may use. " + privilegeFix(programPath()));
}

StageThread::~StageThread() {
  requestStop();
  pthread_join(thread_, nullptr);
}

void StageThread::requestStop() noexcept { running_->stop.request_stop(); }

const std::optional<std::string>& StageThread::refusal() const { return running_->refusal; }

}  // namespace nanomap
