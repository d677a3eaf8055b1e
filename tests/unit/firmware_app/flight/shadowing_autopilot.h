#pragma once

#include <atomic>
#include <deque>
#include <mutex>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

#include "drivers/mavlink/autopilot_link.h"
#include "firmware_app/pipeline/message_intake.h"

namespace nanomap::test {

/// An autopilot whose vehicle moves as a log's poses tell, whatever it is told: a log can be flown with it. Its pilot
/// switches to external control when told to. Threads: any.
class ShadowingAutopilot : public AutopilotLink {
 public:
  static constexpr double kHeading_rad = 0.7;  ///< of W in NED

  ShadowingAutopilot() {
    state_.kind = AutopilotKind::kPx4;
    state_.linked = true;
    state_.armed = true;
    state_.simulated = true;
  }

  /// Moves the vehicle to a pose of the log, as it is sent.
  void move(Bytes pose_message, Time now) {
    auto read = intake_.read(InputKind::kPose, pose_message);
    const auto* input = std::get_if<Input>(&read);
    if (input == nullptr) return;
    const Pose& T_W_B = std::get<PoseInput>(*input).pose.T_W_B;
    const std::lock_guard lock(mutex_);
    poses_.push_back({now, T_NED_W_.point(T_W_B.translation_m), T_NED_W_.heading(yawOf(T_W_B.rotation))});
  }

  void order() {
    const std::lock_guard lock(mutex_);
    state_.external_control = true;
    ++state_.external_control_entries;
  }

  [[nodiscard]] SystemStatus status() const { return status_.load(); }
  [[nodiscard]] std::size_t targets() const { return targets_.load(); }

  void keepAlive(SystemStatus status) override { status_ = status; }
  SendResult send(const LocalNedTarget&) override {
    ++targets_;
    return SendResult::kSent;
  }
  SendResult send(const ObstacleDistances&) override { return SendResult::kSent; }
  SendResult send(const OdometryMessage&) override { return SendResult::kSent; }
  SendResult sendText(Severity, std::string_view) override { return SendResult::kSent; }
  [[nodiscard]] AutopilotState autopilot() const override {
    const std::lock_guard lock(mutex_);
    return state_;
  }
  std::optional<AutopilotPose> takePose() override {
    const std::lock_guard lock(mutex_);
    if (poses_.empty()) return std::nullopt;
    const AutopilotPose pose = poses_.front();
    poses_.pop_front();
    return pose;
  }

 private:
  const NedFromWorld T_NED_W_{kHeading_rad, {10.0, 20.0, -5.0}};
  MessageIntake intake_{LcmParameters{}};
  mutable std::mutex mutex_;
  AutopilotState state_;
  std::deque<AutopilotPose> poses_;
  std::atomic<SystemStatus> status_{SystemStatus::kBoot};
  std::atomic<std::size_t> targets_{0};
};

}  // namespace nanomap::test
