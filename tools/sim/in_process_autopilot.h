#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "drivers/mavlink/autopilot_link.h"

namespace nanomap::sim {

/// The way to an autopilot in the same process, on a simulated clock: keeps what is said to it, and hands out what
/// whoever plays the autopilot says. Threads: one.
class InProcessAutopilot : public AutopilotLink {
 public:
  void keepAlive(SystemStatus told) override { status = told; }
  [[nodiscard]] SendResult send(const LocalNedTarget& told) override {
    target = HeardTarget{now, told};
    ++targets;
    return SendResult::kSent;
  }
  [[nodiscard]] SendResult send(const ObstacleDistances& /*distances*/) override {
    ++obstacles;
    return SendResult::kSent;
  }
  [[nodiscard]] SendResult send(const OdometryMessage& /*odometry*/) override {
    ++odometries;
    return SendResult::kSent;
  }
  [[nodiscard]] SendResult sendText(Severity /*severity*/, std::string_view text) override {
    texts.emplace_back(text);
    return SendResult::kSent;
  }
  [[nodiscard]] AutopilotState autopilot() const override { return state; }
  [[nodiscard]] std::optional<AutopilotPose> takePose() override {
    if (poses.empty()) return std::nullopt;
    const AutopilotPose pose = poses.front();
    poses.pop_front();
    return pose;
  }

  /// The pilot gives the order to fly.
  void switchToExternalControl() {
    state.external_control = true;
    ++state.external_control_entries;
  }

  struct HeardTarget {
    Time at{};
    LocalNedTarget target;

    [[nodiscard]] bool withPosition() const { return (target.type_mask & kIgnoresPosition) == 0; }
  };

  Time now{};

  AutopilotState state;             ///< as it tells it
  std::deque<AutopilotPose> poses;  ///< told, and not taken yet

  SystemStatus status = SystemStatus::kBoot;  ///< of the flight process, as it said last
  std::optional<HeardTarget> target;          ///< the newest
  std::uint64_t targets = 0;                  ///< heard so far, as are
  std::uint64_t obstacles = 0;
  std::uint64_t odometries = 0;
  std::vector<std::string> texts;

 private:
  static constexpr std::uint16_t kIgnoresPosition = 0b111;  ///< POSITION_TARGET_TYPEMASK: x, y, z
};

}  // namespace nanomap::sim
