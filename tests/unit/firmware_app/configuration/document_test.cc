#include "firmware_app/configuration/document.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <regex>
#include <sstream>

#include "firmware_app/configuration/load.h"
#include "firmware_app/configuration/sections.h"

namespace nanomap {
namespace {

using ::testing::HasSubstr;

Configuration parsed(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return parseConfiguration(text, "document", overrides);
}

std::string defaultFile() {
  std::ifstream in(NANOMAP_DEFAULT_CONFIGURATION);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Every section and key of the document made active.
std::string uncommented(const std::string& document) {
  return std::regex_replace(document, std::regex("\n#(\\[?[a-z])"), "\n$1");
}

TEST(Document, DefaultFileInTheRepositoryIsUpToDate) {
  EXPECT_EQ(defaultFile(), annotatedToml(Configuration{}))
      << "Write it anew: nanomap-replay --help-config > firmware_app/config/default.toml";
}

TEST(Document, DefaultFileChangesNothing) {
  EXPECT_EQ(annotatedToml(parsed(defaultFile())), annotatedToml(Configuration{}));
}

TEST(Document, EveryKeyIsThereWithItsHelp) {
  const std::string document = annotatedToml(Configuration{});
  for (const Section& section : sections()) {
    EXPECT_THAT(document, HasSubstr("[" + section.name + "]\n"));
    for (const Key& key : section.keys) {
      EXPECT_FALSE(key.help.empty()) << qualifiedName(section, key);
      EXPECT_THAT(document, HasSubstr("(" + describe(key.rule))) << qualifiedName(section, key);
      EXPECT_THAT(document, HasSubstr(key.name + " = ")) << qualifiedName(section, key);
    }
  }
}

TEST(Document, EveryDefaultObeysItsOwnRule) {
  Configuration example;
  for (const Section& section : sections()) {
    if (section.optional) section.optional->fill_example(example);
    for (const Key& key : section.keys) {
      EXPECT_TRUE(accept(key.rule, key.read(example))) << qualifiedName(section, key);
    }
  }
}

TEST(Document, ExampleCameraIsAValidOne) {
  std::string text = uncommented(annotatedToml(Configuration{}));
  text = std::regex_replace(text, std::regex("rotation_wxyz = .*\n"), "");
  EXPECT_TRUE(parsed(text).camera);
}

TEST(Document, RoundTripKeepsEveryValue) {
  const Configuration changed = parsed(
      "", {"history.views=33", "drift.law=linear", "drift.use_increments=true", "query.k=5", "lcm.pose_t_body=frd",
           "lcm.depth_channel=D\"1", "drift.horizontal_std_m=0.1234567890123", "history.max_lead_s=0.123456789",
           "camera.width_px=64", "camera.height_px=48", "camera.fx_px=60.5", "camera.fy_px=60", "camera.cx_px=31",
           "camera.cy_px=23", "camera.max_range_m=9", "camera.mount_roll_pitch_yaw_deg=[1, 15, -170.5]",
           "camera.position_m=[0.1, -0.2, 0.3]", "camera.no_return_values=[]"});
  const std::string document = annotatedToml(changed);
  EXPECT_THAT(document, HasSubstr("mount_roll_pitch_yaw_deg = [1.0, 15.0, -170.5]"));
  EXPECT_THAT(document, HasSubstr("views = 33  # default 150"));
  const Configuration again = parsed(document);
  EXPECT_EQ(annotatedToml(again), document);
  EXPECT_EQ(again.chain.max_lead, std::chrono::nanoseconds(123456789));
  EXPECT_EQ(again.lcm.depth_channel, "D\"1");
}

TEST(Document, LinesFitAScreen) {
  std::istringstream lines(annotatedToml(Configuration{}));
  for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 120U) << line;
}

}  // namespace
}  // namespace nanomap
