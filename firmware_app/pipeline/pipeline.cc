#include "firmware_app/pipeline/pipeline.h"

#include <chrono>
#include <utility>

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
      chain_(configuration.chain, configuration.safety.stuck_depth) {}

Pipeline::Outcome Pipeline::feed(InputKind kind, Bytes message) {
  auto input = read(kind, message);
  return input ? take(*std::move(input)) : Outcome{};
}

std::optional<Input> Pipeline::read(InputKind kind, Bytes message) {
  count(counters_.messages, kind);
  auto outcome = intake_.read(kind, message);
  if (const auto* fault = std::get_if<DecodeFault>(&outcome)) {
    count(counters_.decode_faults[static_cast<std::size_t>(kind)], *fault);
    return std::nullopt;
  }
  if (const auto* fault = std::get_if<ConvertFault>(&outcome)) {
    count(counters_.convert_faults[static_cast<std::size_t>(kind)], *fault);
    return std::nullopt;
  }
  return std::get<Input>(std::move(outcome));
}

Pipeline::Outcome Pipeline::take(Input input) {
  return std::visit([this](const auto& one) { return takeOne(one); }, input);
}

template <class Other>
Pipeline::Outcome Pipeline::takeOne(const Other& input) {
  return {.views_inserted = chain_.take(input)};
}

Pipeline::Outcome Pipeline::takeOne(const CameraInput& camera) {
  const CameraVerdict verdict = view_builder_.setCamera(camera);
  count(counters_.cameras, verdict);
  return {.camera = verdict};
}

Pipeline::Outcome Pipeline::takeOne(const DepthInput& depth) {
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
  const Duration build_time = std::chrono::steady_clock::now() - start;
  return {.views_inserted = chain_.take(std::get<ViewPtr>(std::move(built))), .build_time = build_time};
}

}  // namespace nanomap
