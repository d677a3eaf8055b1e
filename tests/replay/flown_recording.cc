#include "tests/replay/flown_recording.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <variant>

#include "bot_core/images_t.hpp"
#include "drivers/lcm/convert.h"
#include "drivers/lcm/encode.h"
#include "drivers/recording/log_writer.h"
#include "firmware_app/configuration/document.h"
#include "firmware_app/pipeline/chain_stage.h"
#include "firmware_app/pipeline/stamp_clock.h"
#include "firmware_app/pipeline/step.h"
#include "firmware_app/pipeline/view_builder.h"
#include "nanomap/text_t.hpp"
#include "planner/receding_horizon.h"
#include "tests/support/flight_log.h"

namespace nanomap::test {
namespace {

using std::chrono::milliseconds;

constexpr std::int64_t kFlight_ms = 2000;
constexpr std::int64_t kPosePeriod_ms = 10;
constexpr std::int64_t kFramePeriod_ms = 33;
constexpr std::int64_t kCorrectionPeriod_ms = 500;
constexpr std::int64_t kJump_ms = 1400;  ///< of the estimator's world

/// The vehicle is flown by what is decided between these.
constexpr std::int64_t kHandedOver_ms = 500;
constexpr std::int64_t kTakenBack_ms = 1700;

constexpr std::int64_t kRecorderPeriod_ms = 40;

template <class Message>
std::vector<std::uint8_t> bytesOfMessage(const Message& message) {
  std::vector<std::uint8_t> bytes;
  EXPECT_TRUE(encodeInto(message, bytes));
  return bytes;
}

/// Something that came in: its message and what it says.
struct Arrived {
  InputKind kind = InputKind::kPose;
  Time at{};
  std::vector<std::uint8_t> message;
  std::optional<Input> input{};
  Duration stamp_shift{};
};

/// Something that is ready to be taken in by the chain.
struct Ready {
  std::size_t arrived = 0;  ///< index
  Time at{};
};

class Flight {
 public:
  Flight(FlightMessages messages, unsigned seed) : messages_(messages), random_(seed) {
    flown_.configuration.planner.objective.min_altitude_W_m = -10.0;
    flown_.start = atMs(5000);
  }

  FlownRecording fly() && {
    publish();
    ingest();
    buildViews();
    for (const InputKind kind : {InputKind::kPose, InputKind::kCorrection, InputKind::kGoal}) queueDirectly(kind);
    takeInAndPlan();
    record();
    return std::move(flown_);
  }

 private:
  Duration between(int min_ms, int max_ms) {
    return std::chrono::microseconds(std::uniform_int_distribution<int>(1000 * min_ms, 1000 * max_ms)(random_));
  }

  /// On the process's own clock.
  Time at(std::int64_t ms) const { return flown_.start + milliseconds(ms); }

  const LcmParameters& lcm() const { return flown_.configuration.lcm; }

  template <class Message>
  void publish(InputKind kind, std::int64_t ms, int min_delay_ms, int max_delay_ms, const Message& message) {
    arrived_.push_back({kind, at(ms) + between(min_delay_ms, max_delay_ms), bytesOfMessage(message)});
  }

  void publish() {
    publish(InputKind::kCamera, 0, 0, 1, toMessage(smallCamera(), "front", atMs(0)));
    for (const std::int64_t ms : {200, 1500}) publishGoal(ms);
    CameraParameters moved = smallCamera();
    moved.T_B_C.translation_m.x() = 0.1;
    publish(InputKind::kCamera, 900, 0, 1, toMessage(moved, "front", atMs(900)));
    for (std::int64_t ms = 0; ms <= kFlight_ms; ms += kPosePeriod_ms) publishPose(ms);
    for (std::int64_t ms = 0; ms <= kFlight_ms; ms += kFramePeriod_ms) publishFrame(ms);
    for (std::int64_t ms = kCorrectionPeriod_ms; ms < kJump_ms; ms += kCorrectionPeriod_ms) publishCorrection(ms);
  }

  BodyPose poseAt(std::int64_t ms) const {
    BodyPose pose = FlightLog::flightPose(ms);
    if (ms >= kJump_ms) {
      pose.T_W_B.translation_m.y() += 50.0;
      pose.epoch = 1;
    }
    return pose;
  }

  void publishPose(std::int64_t ms) {
    const BodyPose pose = poseAt(ms);
    if (messages_ == FlightMessages::kPlain) {
      publish(InputKind::kPose, ms, 1, 12, toPoseMessage(pose, BodyConvention::kFlu));
    } else {
      BodyMotion motion;
      motion.velocity_W_m_s.x() = FlightLog::kSpeed_m_s;
      publish(InputKind::kPose, ms, 1, 12, toMessage(pose, motion));
    }
  }

  void publishFrame(std::int64_t ms) {
    const DepthImage image = FlightLog::flightImage(ms);
    if (messages_ == FlightMessages::kNumbered) {
      return publish(InputKind::kDepth, ms, 10, 30, toMessage(image, "front", DepthCompression::kRaw));
    }
    bot_core::image_t depth{};
    depth.width = static_cast<std::int32_t>(image.width_px);
    depth.height = static_cast<std::int32_t>(image.height_px);
    depth.row_stride = 2 * depth.width;
    for (const std::uint16_t pixel : image.pixels) {
      depth.data.push_back(static_cast<std::uint8_t>(pixel & 0xFF));
      depth.data.push_back(static_cast<std::uint8_t>(pixel >> 8));
    }
    depth.size = static_cast<std::int32_t>(depth.data.size());
    bot_core::images_t message{};
    message.utime = utimeFromTime(image.stamp);
    message.n_images = 1;
    message.image_types = {bot_core::images_t::DEPTH_MM};
    message.images = {depth};
    publish(InputKind::kDepth, ms, 10, 30, message);
  }

  void publishGoal(std::int64_t ms) {
    goal_t goal{};
    goal.utime = utimeFromTime(atMs(ms));
    goal.sequence = ms;
    goal.epoch = ms >= kJump_ms ? 1 : 0;
    goal.position[0] = 5.0;
    goal.position[1] = ms >= kJump_ms ? 50.0 : 1.0;
    goal.top_speed = 2.0;
    publish(InputKind::kGoal, ms, 1, 5, goal);
  }

  void publishCorrection(std::int64_t ms) {
    Correction correction;
    correction.sequence = static_cast<std::uint64_t>(ms);
    for (std::int64_t then = ms - kCorrectionPeriod_ms; then <= ms; then += 5 * kPosePeriod_ms) {
      Pose corrected = poseAt(then).T_W_B;
      corrected.translation_m.x() *= 1.01;
      correction.poses.push_back({atMs(then), corrected});
    }
    publish(InputKind::kCorrection, ms, 20, 60, toMessage(correction, atMs(ms)));
  }

  /// Everything that arrives is read at once, in order.
  void ingest() {
    std::sort(arrived_.begin(), arrived_.end(), [](const Arrived& a, const Arrived& b) { return a.at < b.at; });
    MessageIntake intake(lcm());
    StampClock clock(ClockDomain::kRealtime, SafetyParameters().max_stamp_lead,
                     -flown_.start.time_since_epoch());  // messages count from 0
    Time last{};
    for (Arrived& each : arrived_) {
      each.at = last = std::max(each.at, last + std::chrono::microseconds(1));
      auto outcome = intake.read(each.kind, each.message);
      each.input = std::get<Input>(std::move(outcome));
      if (const auto stamp = stampOf(*each.input)) each.stamp_shift = clock.shift(each.kind, *stamp, each.at).value();
      shiftStamps(*each.input, each.stamp_shift);
    }
  }

  /// T1 and T2: camera models pass, of the images the newest is taken whenever the builder is free.
  void buildViews() {
    Time free_at{};
    for (std::size_t i = 0; i < arrived_.size(); ++i) {
      const bool camera = arrived_[i].kind == InputKind::kCamera;
      if (!camera && arrived_[i].kind != InputKind::kDepth) continue;
      const Time start = std::max(free_at, arrived_[i].at);
      const auto newer = std::find_if(arrived_.begin() + static_cast<std::ptrdiff_t>(i) + 1, arrived_.end(),
                                      [](const Arrived& a) { return a.kind == InputKind::kDepth; });
      if (!camera && newer != arrived_.end() && newer->at <= start) {
        ++flown_.frames_dropped;
        continue;
      }
      free_at = start + (camera ? Duration{} : between(15, 60));
      from_builder_.push_back({i, free_at});
    }
  }

  /// Straight to the chain, which wakes up when it can; of one kind in order.
  void queueDirectly(InputKind kind) {
    Time last{};
    for (std::size_t i = 0; i < arrived_.size(); ++i) {
      if (arrived_[i].kind != kind) continue;
      last = std::max(last, arrived_[i].at + between(0, 8));
      ready_.push_back({i, last});
    }
  }

  /// T3 and T4.
  void takeInAndPlan() {
    ready_.insert(ready_.end(), from_builder_.begin(), from_builder_.end());
    std::stable_sort(ready_.begin(), ready_.end(), [](const Ready& a, const Ready& b) { return a.at < b.at; });
    ViewBuilder builder(flown_.configuration.camera, flown_.configuration.index);
    ChainStage chain(flown_.configuration.chain);
    RecedingHorizon horizon(flown_.configuration.planner);
    ChainSnapshot snapshot;
    Time planner_free_at{};
    Time last_arrival{};
    for (std::size_t i = 0; i < ready_.size(); ++i) {
      const Arrived& arrived = arrived_[ready_[i].arrived];
      const Step step{ready_[i].at, i + 1, arrived.kind, arrived.at, arrived.stamp_shift};
      if (arrived.at < last_arrival) ++flown_.overtaken;
      last_arrival = std::max(last_arrival, arrived.at);
      put(lcm().steps_channel, step.taken, toMessage(step));
      takeIn(*arrived.input, builder, chain);

      const Time next = i + 1 < ready_.size() ? ready_[i + 1].at : Time::max();
      const Time now = std::max(planner_free_at, step.taken + between(0, 1));
      if (now >= next || !chain.state()) continue;
      chain.chain().snapshotInto(snapshot);
      const bool flown = now >= at(kHandedOver_ms) && now < at(kTakenBack_ms);
      if (!flown) horizon.release();
      const Decision decision = horizon.step(snapshot, *chain.state(), chain.goal(), now);
      planner_free_at = now + between(20, 50);
      put(lcm().decisions_channel, planner_free_at,
          toMessage(decision, {.sequence = flown_.decisions++, .step = step.number, .flown = flown}));
    }
  }

  static void takeIn(const Input& input, ViewBuilder& builder, ChainStage& chain) {
    if (const auto* camera = std::get_if<CameraInput>(&input)) {
      (void)builder.setCamera(*camera);
    } else if (const auto* depth = std::get_if<DepthInput>(&input)) {
      auto view = builder.build(*depth);
      chain.take(std::get<ViewPtr>(std::move(view)));
    } else if (const auto* pose = std::get_if<PoseInput>(&input)) {
      chain.take(*pose);
    } else if (const auto* correction = std::get_if<Correction>(&input)) {
      chain.take(*correction);
    } else {
      chain.take(std::get<Goal>(input));
    }
  }

  template <class Message>
  void put(const std::string& channel, Time stamp, const Message& message, Retention retention = Retention::kOnce) {
    handed_over_[channel].push_back({channel, stamp, bytesOfMessage(message), retention});
  }

  /// By turns from each tap, so that the stamps of the log go back and forth.
  void record() {
    text_t configuration{};
    configuration.text = annotatedToml(flown_.configuration);
    put(std::string(kConfigurationChannel), at(0), configuration, Retention::kHolds);
    for (const Arrived& each : arrived_) {
      const bool holds = each.kind == InputKind::kCamera || each.kind == InputKind::kGoal;
      handed_over_["raw"].push_back(
          {channelOf(lcm(), each.kind), each.at, each.message, holds ? Retention::kHolds : Retention::kOnce});
    }
    std::map<std::string, std::size_t> written;
    for (Time now = at(0); now < at(2 * kFlight_ms); now += milliseconds(kRecorderPeriod_ms)) {
      for (auto& [tap, events] : handed_over_) {
        for (std::size_t& next = written[tap]; next < events.size() && events[next].log_stamp <= now; ++next) {
          flown_.events.push_back(events[next]);
        }
      }
    }
  }

  FlightMessages messages_;
  std::mt19937 random_;
  FlownRecording flown_;
  std::vector<Arrived> arrived_;
  std::vector<Ready> from_builder_;
  std::vector<Ready> ready_;
  std::map<std::string, std::vector<RecordedEvent>> handed_over_;
};

}  // namespace

std::vector<RecordedEvent> FlownRecording::on(const std::string& channel) const {
  std::vector<RecordedEvent> found;
  std::copy_if(events.begin(), events.end(), std::back_inserter(found),
               [&](const RecordedEvent& event) { return event.channel == channel; });
  return found;
}

FlownRecording flownRecording(FlightMessages messages, unsigned seed) { return Flight(messages, seed).fly(); }

std::filesystem::path writeLog(const std::vector<RecordedEvent>& events, const std::filesystem::path& path) {
  LogWriter log(path);
  for (const RecordedEvent& event : events) log.writeEncoded(event.channel, event.log_stamp, event.message);
  log.close();
  return path;
}

void writeSegments(const std::vector<RecordedEvent>& events, const std::filesystem::path& folder,
                   const RotationLimits& limits) {
  RotatingLog log(folder, limits, Time{});
  for (const RecordedEvent& event : events) {
    EXPECT_TRUE(log.write(event.channel, event.log_stamp, event.message, event.retention));
  }
  log.close();
}

}  // namespace nanomap::test
