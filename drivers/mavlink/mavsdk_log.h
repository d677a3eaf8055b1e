#pragma once

#include <cstdint>
#include <functional>
#include <string_view>

namespace nanomap {

/// Takes what MAVSDK has to say, which otherwise goes to the standard output. MAVSDK knows one listener a process: make
/// one of these, before the first link, and keep it longer than every link.
class MavsdkLog {
 public:
  enum class Level : std::uint8_t { kDebug, kInfo, kWarning, kError };
  using Listener = std::function<void(Level level, std::string_view message)>;

  /// @param listener  called on any of MAVSDK's threads; must neither block nor throw
  explicit MavsdkLog(Listener listener);
  ~MavsdkLog();
  MavsdkLog(const MavsdkLog&) = delete;
  MavsdkLog& operator=(const MavsdkLog&) = delete;

 private:
  Listener listener_;
};

}  // namespace nanomap
