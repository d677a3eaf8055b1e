#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "firmware_app/handover/doorbell.h"
#include "firmware_app/handover/mailbox.h"
#include "firmware_app/handover/slot_queue.h"
#include "firmware_app/pipeline/view_builder.h"
#include "firmware_app/stages/handed_over.h"

namespace nanomap {

struct IndexCounters {
  std::array<std::uint64_t, kCameraVerdictCount> cameras{};
  std::array<std::uint64_t, kCameraFaultCount> camera_faults{};
  std::array<std::uint64_t, kImageFaultCount> image_faults{};
  std::uint64_t views = 0;
};

/// What the index stage takes from and gives to. Borrowed.
struct IndexPorts {
  SlotQueue<ArrivedCamera>& cameras;
  SlotQueue<ArrivedFrame>& frames;
  SlotQueue<IndexedFrame>& indexed;  ///< for the chain,
  Doorbell& chain_bell;              ///< which is rung
  Mailbox<IndexCounters>& counters;
};

/// Stage T2 as it runs: camera models first, then frames to views, in the order of their arrival. A frame that the
/// chain has no room for is lost, which is counted; a camera model waits until there is room, since a replay that lacks
/// its step would see all that follows through another camera. Allocates: for a new camera model, and as ViewPool does.
/// Threads: one.
class IndexStage {
 public:
  IndexStage(ViewBuilder builder, const IndexPorts& ports);

  /// Takes all that waits; how many things there were.
  std::size_t run();

  /// Arrival of the newest depth frame taken; empty before the first.
  [[nodiscard]] std::optional<Time> newestFrame() const { return newest_frame_; }

 private:
  void take(const ArrivedCamera& arrived);
  void take(const ArrivedFrame& arrived);
  void hand(const IndexedFrame& frame);

  ViewBuilder builder_;
  IndexPorts ports_;
  IndexCounters counters_;
  std::optional<Time> newest_frame_;
};

}  // namespace nanomap
