#include "firmware_app/pipeline/pipeline.h"

#include <chrono>
#include <utility>

#include "firmware_app/pipeline/vehicle_state.h"

namespace nanomap {
namespace {

template <class Counters, class Enum>
void count(Counters& counters, Enum value) {
  ++counters[static_cast<std::size_t>(value)];
}

}  // namespace

Pipeline::Pipeline(const Configuration& configuration)
    : intake_(configuration.lcm),
      view_builder_(configuration.camera, configuration.index,
                    configuration.chain.history_views + configuration.chain.waiting_views),
      chain_(configuration.chain) {}

Pipeline::Outcome Pipeline::feed(InputKind kind, Bytes message) {
  count(counters_.messages, kind);
  auto outcome = intake_.read(kind, message);
  if (const auto* fault = std::get_if<DecodeFault>(&outcome)) {
    count(counters_.decode_faults[static_cast<std::size_t>(kind)], *fault);
    return {};
  }
  if (const auto* fault = std::get_if<ConvertFault>(&outcome)) {
    count(counters_.convert_faults[static_cast<std::size_t>(kind)], *fault);
    return {};
  }
  return std::visit([this](auto&& input) { return take(std::move(input)); }, std::get<Input>(std::move(outcome)));
}

Pipeline::Outcome Pipeline::take(const PoseInput& input) {
  const Chain::PoseOutcome outcome = chain_.addPose(input.pose);
  const bool newest = !state_ || input.pose.stamp > state_->stamp;
  if (newest && outcome.verdict == PoseVerdict::kAccepted) {
    state_ = vehicleStateAt(input.pose, input.motion, chain_.poses());
  }
  return {.views_inserted = outcome.views_inserted};
}

Pipeline::Outcome Pipeline::take(const Correction& correction) {
  chain_.addCorrection(correction);
  return {};
}

Pipeline::Outcome Pipeline::take(const Goal& goal) {
  goal_ = goal;
  return {};
}

Pipeline::Outcome Pipeline::take(const CameraInput& camera) {
  const CameraVerdict verdict = view_builder_.setCamera(camera);
  count(counters_.cameras, verdict);
  return {.camera = verdict};
}

Pipeline::Outcome Pipeline::take(const DepthInput& depth) {
  const auto start = std::chrono::steady_clock::now();
  auto built = view_builder_.build(depth);
  if (const auto* fault = std::get_if<CameraFault>(&built)) {
    count(counters_.camera_faults, *fault);
    return {};
  }
  if (const auto* fault = std::get_if<ImageFault>(&built)) {
    count(counters_.image_faults, *fault);
    return {};
  }
  Outcome outcome{.build_time = std::chrono::steady_clock::now() - start};
  const Chain::ViewOutcome entered = chain_.addView(std::get<ViewPtr>(std::move(built)));
  if (!entered.waiting && !entered.drop) outcome.views_inserted = 1;
  return outcome;
}

}  // namespace nanomap
