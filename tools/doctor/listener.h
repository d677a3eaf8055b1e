#pragma once

#include <map>
#include <optional>
#include <string>

#include "drivers/lcm/message_source.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/doctor/heard.h"

namespace nanomap::doctor {

/// Which depth frames are kept: some seconds in a row, so that the vehicle moves between them, several times, evenly
/// over all of what is listened to.
class FrameSampling {
 public:
  FrameSampling(Time start, Duration length);

  /// @param arrival  of the frame asked about, never before that of the last one
  [[nodiscard]] bool wants(Time arrival);

 private:
  Time start_;
  Duration period_;
  std::optional<Time> kept_;
};

/// Sorts out messages. Threads: one. Allocates what it keeps: each stamp, each pose, a sample of the frames.
class Listener {
 public:
  Listener(const LcmParameters& lcm, Time start, Duration length);

  /// @param message  untrusted, of any channel
  void take(const ReceivedMessage& message, Time arrival);

  [[nodiscard]] Heard finish() &&;

 private:
  void takeInput(InputKind kind, const ReceivedMessage& message, Time arrival);
  void keep(InputKind kind, Input input, Time arrival);

  std::string health_channel_;
  MessageIntake intake_;
  FrameSampling sampling_;
  std::map<std::string, HeardChannel, std::less<>> channels_;
  Heard heard_;
};

}  // namespace nanomap::doctor
