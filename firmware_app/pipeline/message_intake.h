#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "core/camera_model.h"
#include "core/correction.h"
#include "core/depth_image.h"
#include "core/goal.h"
#include "core/pose_buffer.h"
#include "drivers/lcm/convert.h"
#include "drivers/lcm/decode.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/pipeline/epoch_assigner.h"

namespace nanomap {

/// What NanoMap takes in from LCM.
enum class InputKind : std::uint8_t { kPose, kCorrection, kCamera, kDepth, kGoal };
inline constexpr std::size_t kInputKindCount = 5;

[[nodiscard]] std::string_view toString(InputKind kind);

/// The configured channel of that kind.
[[nodiscard]] const std::string& channelOf(const LcmParameters& lcm, InputKind kind);

struct PoseInput {
  BodyPose pose;
  std::optional<BodyMotion> motion;  ///< empty: the message does not say
  bool numbered = true;              ///< by its publisher, else by us
};

struct CameraInput {
  std::string name;
  CameraParameters parameters;
};

struct DepthInput {
  std::string camera;  ///< empty: the message does not say
  DepthImage image;
  bool numbered = true;  ///< by its publisher, else by us
};

/// Alternatives in the order of InputKind.
using Input = std::variant<PoseInput, Correction, CameraInput, DepthInput, Goal>;

/// Messages of the configured channels as values of core, whatever type carries them: each type is recognised by its
/// hash. Numbers the messages of types that have no sequence number, and raises the epoch of all that comes after a
/// jump of the estimator's world that the estimator did not tell (epoch_assigner.h); but a goal that is sent again
/// stays in the world that it was sent in first, for its sender knows of no jump either. Threads: one.
class MessageIntake {
 public:
  explicit MessageIntake(const LcmParameters& lcm) : lcm_(lcm), epochs_(lcm.max_body_speed_m_s) {}

  /// Empty if the channel is none of those configured.
  [[nodiscard]] std::optional<InputKind> kindOf(std::string_view channel) const;

  using Outcome = std::variant<Input, DecodeFault, ConvertFault>;
  /// @param message  untrusted bytes from the channel of `kind`
  [[nodiscard]] Outcome read(InputKind kind, Bytes message);

 private:
  [[nodiscard]] Outcome readPose(Bytes message);
  [[nodiscard]] Outcome readDepth(Bytes message);
  [[nodiscard]] std::uint32_t epochOf(const Goal& sent);

  LcmParameters lcm_;
  EpochAssigner epochs_;
  std::optional<Goal> goal_sent_;  ///< last, as it was
  std::uint32_t goal_epoch_ = 0;   ///< of that
  std::uint64_t unnumbered_poses_ = 0;
  std::uint64_t unnumbered_images_ = 0;
};

}  // namespace nanomap
