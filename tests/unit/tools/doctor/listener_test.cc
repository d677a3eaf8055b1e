#include "tools/doctor/listener.h"

#include <gtest/gtest.h>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/encode.h"
#include "nanomap/health_t.hpp"
#include "tests/support/drawing.h"
#include "tests/unit/tools/doctor/vehicle.h"

namespace nanomap::doctor {
namespace {

using namespace std::chrono_literals;

template <class Message>
void send(Listener& listener, const std::string& channel, const Message& message, Time arrival) {
  std::vector<std::uint8_t> bytes;
  ASSERT_TRUE(encodeInto(message, bytes));
  listener.take({.channel = channel, .bytes = bytes, .log_stamp = std::nullopt}, arrival);
}

TEST(Listener, SortsMessagesByChannelAndNamesTheirTypes) {
  Listener listener({}, atMs(0), 1s);
  const CameraParameters camera = test::smallCamera();
  send(listener, "CAMERA", toMessage(camera, "front", atMs(1)), atMs(2));
  BodyPose pose;
  pose.stamp = atMs(5);
  send(listener, "POSE_BODY", toMessage(pose, std::nullopt), atMs(7));
  send(listener, "ELSEWHERE", toPoseMessage(pose, BodyConvention::kFlu), atMs(8));
  DepthImage image = test::flatImage(CameraModel(camera), 7, atMs(9));
  send(listener, "DEPTH", toMessage(image, "front", DepthCompression::kRaw), atMs(12));
  health_t health{};
  health.state = "ready";
  send(listener, "NANOMAP_HEALTH", health, atMs(13));

  const Heard heard = std::move(listener).finish();
  EXPECT_EQ(heard.channel("ELSEWHERE")->type, "bot_core.pose_t");
  EXPECT_EQ(heard.channel("NOBODY"), nullptr);
  EXPECT_EQ(heard.stream(InputKind::kPose).sightings.at(0).stamp, atMs(5));
  EXPECT_EQ(heard.stream(InputKind::kPose).sightings.at(0).arrival, atMs(7));
  EXPECT_EQ(heard.poses.size(), 1U);
  EXPECT_EQ(heard.frames.size(), 1U);
  EXPECT_EQ(heard.camera->parameters, camera);
  EXPECT_EQ(heard.health->state, "ready");
}

TEST(Listener, WhatCannotBeReadIsCountedAndSaid) {
  Listener listener({}, atMs(0), 1s);
  const std::vector<std::uint8_t> garbage = {1, 2, 3};
  listener.take({.channel = "DEPTH", .bytes = garbage, .log_stamp = std::nullopt}, atMs(1));
  const Heard heard = std::move(listener).finish();
  EXPECT_EQ(heard.stream(InputKind::kDepth).unreadable, 1U);
  EXPECT_FALSE(heard.stream(InputKind::kDepth).fault.empty());
  EXPECT_EQ(heard.channel("DEPTH")->type, "");
}

TEST(FrameSampling, KeepsSecondsInARowSeveralTimesOverAllOfIt) {
  FrameSampling sampling(atMs(0), 120s);
  int kept = 0;
  int kept_of_first_burst = 0;
  for (int ms = 0; ms < 120'000; ms += 33) {
    if (!sampling.wants(atMs(ms))) continue;
    ++kept;
    if (ms < 5'000) ++kept_of_first_burst;
  }
  EXPECT_NEAR(kept_of_first_burst, 13, 2);
  EXPECT_NEAR(kept, 12 * 13, 24);
}

TEST(FrameSampling, ShortTimeIsKeptWhole) {
  FrameSampling sampling(atMs(0), 5s);
  int kept = 0;
  for (int ms = 0; ms < 5'000; ms += 100) kept += sampling.wants(atMs(ms)) ? 1 : 0;
  EXPECT_EQ(kept, 25);
}

}  // namespace
}  // namespace nanomap::doctor
