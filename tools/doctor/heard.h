#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "core/pose_buffer.h"
#include "core/time.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap::doctor {

/// When a message says that it was, by the sender's clock, and when it came.
struct Sighting {
  Time stamp{};
  Time arrival{};  ///< by CLOCK_MONOTONIC of this machine; from a log, when it was logged
};

/// Whatever was heard on one channel, ours or not.
struct HeardChannel {
  std::string name;
  std::string type;  ///< as "nanomap.body_pose_t"; empty: none of lcm_types
  std::uint64_t messages = 0;
};

/// What came on the channel that is configured for one kind of input.
struct HeardStream {
  std::vector<Sighting> sightings;  ///< in the order of arrival; none of messages without a stamp
  std::uint64_t messages = 0;       ///< that could be read
  std::uint64_t unreadable = 0;
  std::string fault;  ///< of the last of those, in words
};

/// What the flight process last told about itself.
struct HeardHealth {
  std::string state;
  std::string reason;
};

/// Messages of a while, from the network or from a log.
struct Heard {
  bool from_log = false;
  Duration duration{};        ///< listened for, or of the log
  Duration realtime_ahead{};  ///< time of day minus CLOCK_MONOTONIC; not of a log
  std::vector<HeardChannel> channels;
  std::array<HeardStream, kInputKindCount> streams;  ///< by InputKind
  std::vector<BodyPose> poses;                       ///< in the order of arrival, stamps as sent
  std::vector<DepthInput> frames;                    ///< a sample of the depth frames, stamps as sent
  std::optional<CameraInput> camera;                 ///< the first that described itself
  std::optional<HeardHealth> health;

  [[nodiscard]] const HeardStream& stream(InputKind kind) const { return streams[static_cast<std::size_t>(kind)]; }
  /// Null if nothing was heard on it.
  [[nodiscard]] const HeardChannel* channel(const std::string& name) const;
};

}  // namespace nanomap::doctor
