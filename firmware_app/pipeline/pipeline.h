#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/chain_stage.h"
#include "firmware_app/pipeline/message_intake.h"
#include "firmware_app/pipeline/view_builder.h"

namespace nanomap {

/// Everything that went into a pipeline, by what became of it; the chain counts on from there.
struct PipelineCounters {
  std::array<std::uint64_t, kInputKindCount> messages{};
  std::array<std::array<std::uint64_t, kDecodeFaultCount>, kInputKindCount> decode_faults{};
  std::array<std::array<std::uint64_t, kConvertFaultCount>, kInputKindCount> convert_faults{};
  std::array<std::uint64_t, kCameraVerdictCount> cameras{};
  std::array<std::uint64_t, kCameraFaultCount> camera_faults{};
  std::array<std::uint64_t, kImageFaultCount> image_faults{};
};

/// The sequence "message in, chain moved on" on one thread: what a replay runs, step by step as the flight process's
/// stages T2 and T3 do. A function of the messages and their order; never fails on what they hold, but counts.
/// Threads: one.
class Pipeline {
 public:
  /// @throws std::invalid_argument naming the parameter that is wrong
  explicit Pipeline(const Configuration& configuration);

  struct Outcome {
    std::size_t views_inserted = 0;         ///< views that entered the chain
    std::optional<Duration> build_time{};   ///< measured, if a view was built
    std::optional<CameraVerdict> camera{};  ///< if the message described one
  };
  /// Reads a message and takes it in at once.
  /// @param message  untrusted bytes from the configured channel of `kind`
  Outcome feed(InputKind kind, Bytes message);

  /// The two halves of feed(), for whoever takes things in at another time, or in another order, than they were read.
  /// Empty if the message could not be read.
  [[nodiscard]] std::optional<Input> read(InputKind kind, Bytes message);
  Outcome take(Input input);

  [[nodiscard]] std::optional<InputKind> kindOf(std::string_view channel) const { return intake_.kindOf(channel); }
  [[nodiscard]] const Chain& chain() const { return chain_.chain(); }
  [[nodiscard]] std::uint64_t stuckViews() const { return chain_.counters().stuck_views; }
  [[nodiscard]] const std::optional<VehicleState>& state() const { return chain_.state(); }
  [[nodiscard]] const std::optional<Goal>& goal() const { return chain_.goal(); }
  [[nodiscard]] const ViewBuilder& viewBuilder() const { return view_builder_; }
  [[nodiscard]] const PipelineCounters& counters() const { return counters_; }

 private:
  Outcome takeOne(const CameraInput& camera);
  Outcome takeOne(const DepthInput& depth);
  template <class Other>
  Outcome takeOne(const Other& input);

  MessageIntake intake_;
  ViewBuilder view_builder_;
  ChainStage chain_;
  PipelineCounters counters_;
};

}  // namespace nanomap
