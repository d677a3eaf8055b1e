#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include "drivers/recording/log_index.h"
#include "drivers/recording/log_reader.h"
#include "drivers/recording/log_segment.h"
#include "tests/fuzz/require.h"

namespace nanomap::fuzz {
namespace {

/// A file in memory.
class MemoryFile {
 public:
  MemoryFile(const std::uint8_t* data, std::size_t size) : descriptor_(memfd_create("log", 0)) {
    require(descriptor_ >= 0 && write(descriptor_, data, size) == static_cast<ssize_t>(size));
  }
  ~MemoryFile() { close(descriptor_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;

  [[nodiscard]] std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

 private:
  int descriptor_;
};

/// Events and damage, in turn, are the whole log.
void requireCovered(const LogIndex& index, std::size_t size) {
  std::uint64_t covered = 0;
  for (const LogEvent& event : index.events) {
    covered += kLogHeaderBytes + index.channels.at(event.channel).size() + event.data_bytes;
  }
  for (const LogDamage& damage : index.damage) covered += damage.size_bytes;
  require(covered == size && index.size_bytes == size);
}

void readAll(const std::filesystem::path& path) {
  try {
    LogReader log(path);
    std::vector<std::uint8_t> message;
    for (const LogEvent& event : log.mergedByTime()) {
      log.read(event, message);
      require(message.size() == event.data_bytes);
    }
  } catch (const LogError&) {  // not a log
  }
}

}  // namespace
}  // namespace nanomap::fuzz

/// The bytes are a log, and the name of a part of a recording.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace nanomap;
  const std::string bytes(data, data + size);
  std::istringstream log(bytes);
  const LogIndex index = indexLog(log, kMinLogWindowBytes);
  fuzz::requireCovered(index, size);
  fuzz::readAll(fuzz::MemoryFile(data, size).path());
  static_cast<void>(parseSegmentName(bytes));
  return 0;
}
