#pragma once

#include "core/time.h"
#include "firmware_app/handover/doorbell.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/stages/handed_over.h"

namespace nanomap {

/// Where the capture stage gets depth frames from: a camera, or messages. Threads: one.
class DepthSource {
 public:
  virtual ~DepthSource() = default;

  /// Waits for a frame at most this long, and exchanges it for what `frame` holds, whose storage is used for a later
  /// one. False if none came. Frames that came meanwhile are left out: the newest wins.
  /// Allocates: no.
  [[nodiscard]] virtual bool capture(ArrivedFrame& frame, Duration at_most) = 0;
};

/// Frames that came as messages, from a network or a recording: the ingest has read them already.
class MessageDepthSource : public DepthSource {
 public:
  /// Borrows both.
  MessageDepthSource(Mailbox<ArrivedFrame>& frames, Doorbell& bell) : frames_(frames), bell_(bell) {}

  [[nodiscard]] bool capture(ArrivedFrame& frame, Duration at_most) override {
    const auto exchange = [&](ArrivedFrame& newest) { std::swap(newest, frame); };
    if (frames_.take(exchange)) return true;
    return bell_.wait(at_most) && frames_.take(exchange);
  }

 private:
  Mailbox<ArrivedFrame>& frames_;
  Doorbell& bell_;
};

}  // namespace nanomap
