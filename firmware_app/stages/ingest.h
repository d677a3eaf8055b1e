#pragma once

#include <array>
#include <cstdint>

#include "drivers/lcm/message_source.h"
#include "firmware_app/handover/doorbell.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/pipeline/message_intake.h"
#include "firmware_app/pipeline/stamp_clock.h"
#include "firmware_app/pipeline/stream_loss.h"
#include "firmware_app/stages/handed_over.h"

namespace nanomap {

/// A stamp farther ahead of our time than this is of another clock; taken in, it would hold up all that follows.
inline constexpr Duration kMaxStampLead = std::chrono::milliseconds(500);

/// All messages, by what became of them here.
struct IngestCounters {
  std::array<std::uint64_t, kInputKindCount> messages{};
  std::array<std::array<std::uint64_t, kDecodeFaultCount>, kInputKindCount> decode_faults{};
  std::array<std::array<std::uint64_t, kConvertFaultCount>, kInputKindCount> convert_faults{};
  std::array<std::uint64_t, kInputKindCount> from_future{};
  std::array<std::uint64_t, kInputKindCount> before_clock{};  ///< of a log, before its clock was known
  std::array<StreamLoss, kInputKindCount> loss{};             ///< of depth, poses and corrections
  std::uint64_t clock_steps = 0;                              ///< times that the host's time of day was set
  Duration last_clock_step{};                                 ///< forward, if positive
};

/// Where the ingest puts what it has read. Borrowed.
struct IngestOutputs {
  SlotQueue<ArrivedInput>& inputs;    ///< for the chain,
  Doorbell& chain_bell;               ///< which is rung
  Mailbox<ArrivedFrame>& frames;      ///< for the capture stage,
  Doorbell& capture_bell;             ///< which is rung
  SlotQueue<ArrivedCamera>& cameras;  ///< for the index stage,
  Doorbell& index_bell;               ///< which is rung
  Mailbox<IngestCounters>& counters;
};

/// Takes messages in as they arrive: reads them, moves their stamps to our clock, hands them on. A frame that nobody
/// has captured yet is replaced by the next.
/// Threads: one, of no real-time scheduling: reading allocates.
class Ingest {
 public:
  Ingest(const LcmParameters& lcm, StampClock clock, const IngestOutputs& outputs);

  /// The arrival that a message taken in at `now` is told by: a whole microsecond, later than any before.
  [[nodiscard]] Time arrivalAt(Time now);

  /// How far the host's time of day is ahead of our clock now, as realtimeAhead() measures it; before each take().
  void noteRealtime(Duration realtime_ahead, Time now);

  /// @param arrival  of arrivalAt()
  void take(InputKind kind, Bytes message, Time arrival);

  /// Empty if the channel is none of those configured.
  [[nodiscard]] std::optional<InputKind> kindOf(std::string_view channel) const { return intake_.kindOf(channel); }
  [[nodiscard]] const IngestCounters& counters() const { return counters_; }

 private:
  void noteLoss(InputKind kind, const Input& input);
  void takeIn(Input&& input, Time arrival, Duration stamp_shift);
  void hand(Input&& input, Time arrival, Duration stamp_shift);

  MessageIntake intake_;
  StampClock clock_;
  IngestOutputs outputs_;
  IngestCounters counters_;
  std::array<NumberedStream, kInputKindCount> numbered_;
  std::array<StampedStream, kInputKindCount> unnumbered_;
  Time last_arrival_{};
};

}  // namespace nanomap
