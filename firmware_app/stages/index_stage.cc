#include "firmware_app/stages/index_stage.h"

#include <utility>
#include <variant>

namespace nanomap {

IndexStage::IndexStage(ViewBuilder builder, const IndexPorts& ports) : builder_(std::move(builder)), ports_(ports) {}

std::size_t IndexStage::run() {
  std::size_t taken = 0;
  while (ports_.indexed.hasRoom() && ports_.cameras.pop([this](const ArrivedCamera& arrived) { take(arrived); }))
    ++taken;
  while (ports_.frames.pop([this](const ArrivedFrame& arrived) { take(arrived); })) ++taken;
  if (taken > 0) {
    ports_.counters.put([this](IndexCounters& slot) { slot = counters_; });
    ports_.chain_bell.ring();
  }
  return taken;
}

void IndexStage::take(const ArrivedCamera& arrived) {
  ++counters_.cameras[static_cast<std::size_t>(builder_.setCamera(arrived.camera))];
  hand({arrived.arrival, Duration::zero(), InputKind::kCamera, nullptr, builder_.camera() != nullptr});
}

void IndexStage::take(const ArrivedFrame& arrived) {
  newest_frame_ = arrived.arrival;
  IndexedFrame indexed{arrived.arrival, arrived.stamp_shift, InputKind::kDepth, nullptr, builder_.camera() != nullptr};
  auto built = builder_.build(arrived.depth);
  if (const auto* fault = std::get_if<CameraFault>(&built)) {
    ++counters_.camera_faults[static_cast<std::size_t>(*fault)];
  } else if (const auto* image_fault = std::get_if<ImageFault>(&built)) {
    ++counters_.image_faults[static_cast<std::size_t>(*image_fault)];
  } else {
    ++counters_.views;
    indexed.view = std::get<ViewPtr>(std::move(built));
  }
  hand(indexed);
}

void IndexStage::hand(const IndexedFrame& frame) {
  ports_.indexed.push([&](IndexedFrame& slot) { slot = frame; });
}

}  // namespace nanomap
