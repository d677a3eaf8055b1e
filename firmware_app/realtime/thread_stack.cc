#include "firmware_app/realtime/thread_stack.h"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace nanomap {
namespace {

std::size_t pageBytes() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }

std::size_t roundUp(std::size_t bytes, std::size_t unit) { return (bytes + unit - 1) / unit * unit; }

}  // namespace

ThreadStack::ThreadStack(std::size_t bytes) : guard_bytes_(pageBytes()), bytes_(roundUp(bytes, guard_bytes_)) {
  constexpr int kNoFile = -1;
  mapping_ = mmap(nullptr, guard_bytes_ + bytes_, PROT_READ | PROT_WRITE,
                  MAP_PRIVATE | MAP_ANONYMOUS | MAP_STACK | MAP_POPULATE, kNoFile, 0);
  if (mapping_ == MAP_FAILED) {
    throw std::system_error(errno, std::generic_category(), "a stack of " + std::to_string(bytes_) + " bytes");
  }
  lowest_ = static_cast<std::byte*>(mapping_) + guard_bytes_;
  if (mprotect(mapping_, guard_bytes_, PROT_NONE) != 0) {
    const int error = errno;
    munmap(mapping_, guard_bytes_ + bytes_);
    throw std::system_error(error, std::generic_category(), "the guard of a stack");
  }
}

ThreadStack::~ThreadStack() { munmap(mapping_, guard_bytes_ + bytes_); }

}  // namespace nanomap
