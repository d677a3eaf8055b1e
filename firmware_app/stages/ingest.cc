#include "firmware_app/stages/ingest.h"

#include <algorithm>
#include <utility>
#include <variant>

namespace nanomap {

Ingest::Ingest(const LcmParameters& lcm, StampClock clock, const IngestOutputs& outputs)
    : intake_(lcm), clock_(clock), outputs_(outputs) {}

Time Ingest::arrivalAt(Time now) {
  const Time whole = std::chrono::floor<std::chrono::microseconds>(now);
  last_arrival_ = std::max(whole, last_arrival_ + std::chrono::microseconds(1));
  return last_arrival_;
}

void Ingest::take(InputKind kind, Bytes message, Time arrival) {
  const auto index = static_cast<std::size_t>(kind);
  ++counters_.messages[index];
  auto outcome = intake_.read(kind, message);
  if (const auto* fault = std::get_if<DecodeFault>(&outcome)) {
    ++counters_.decode_faults[index][static_cast<std::size_t>(*fault)];
  } else if (const auto* convert_fault = std::get_if<ConvertFault>(&outcome)) {
    ++counters_.convert_faults[index][static_cast<std::size_t>(*convert_fault)];
  } else {
    Input& input = std::get<Input>(outcome);
    noteLoss(kind, input);
    const auto stamp = stampOf(input);
    const auto shift = stamp ? clock_.shift(kind, *stamp, arrival) : Duration::zero();
    if (!shift) {
      ++counters_.before_clock[index];
    } else {
      takeIn(std::move(input), arrival, *shift);
    }
  }
  outputs_.counters.put([this](IngestCounters& slot) { slot = counters_; });
}

void Ingest::noteRealtime(Duration realtime_ahead, Time now) {
  const auto step = clock_.noteRealtime(realtime_ahead, now);
  if (!step) return;
  ++counters_.clock_steps;
  counters_.last_clock_step = *step;
}

/// Goals and camera models are told again and again, and lose nothing by a gap.
void Ingest::noteLoss(InputKind kind, const Input& input) {
  const auto index = static_cast<std::size_t>(kind);
  const auto note = [&](bool numbered, std::uint64_t sequence, Time stamp) {
    if (numbered) {
      numbered_[index].arrived(sequence, stamp);
      counters_.loss[index] = numbered_[index].loss();
    } else {
      unnumbered_[index].arrived(stamp);
      counters_.loss[index] = unnumbered_[index].loss();
    }
  };
  if (const auto* pose = std::get_if<PoseInput>(&input)) note(pose->numbered, pose->pose.sequence, pose->pose.stamp);
  if (const auto* depth = std::get_if<DepthInput>(&input)) {
    note(depth->numbered, depth->image.sequence, depth->image.stamp);
  }
  const auto* correction = std::get_if<Correction>(&input);
  if (correction != nullptr && !correction->poses.empty()) {
    note(true, correction->sequence, correction->poses.back().stamp);
  }
}

void Ingest::takeIn(Input&& input, Time arrival, Duration stamp_shift) {
  shiftStamps(input, stamp_shift);
  const auto stamp = stampOf(input);
  if (stamp && *stamp - arrival > kMaxStampLead) {
    ++counters_.from_future[input.index()];
  } else {
    hand(std::move(input), arrival, stamp_shift);
  }
}

void Ingest::hand(Input&& input, Time arrival, Duration stamp_shift) {
  if (auto* depth = std::get_if<DepthInput>(&input)) {
    outputs_.frames.put([&](ArrivedFrame& slot) { slot = {arrival, stamp_shift, std::move(*depth)}; });
    outputs_.capture_bell.ring();
  } else if (auto* camera = std::get_if<CameraInput>(&input)) {
    outputs_.cameras.push([&](ArrivedCamera& slot) { slot = {arrival, std::move(*camera)}; });
    outputs_.index_bell.ring();
  } else {
    outputs_.inputs.push([&](ArrivedInput& slot) { slot = {arrival, stamp_shift, std::move(input)}; });
    outputs_.chain_bell.ring();
  }
}

}  // namespace nanomap
