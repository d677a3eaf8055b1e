#include "tools/doctor/finding.h"

#include <gtest/gtest.h>

#include <vector>

namespace nanomap::doctor {
namespace {

TEST(Finding, ReportHasALineForEachWithItsFixAndCountsThem) {
  const std::vector<Finding> findings = {ok("rates", "10 ms"), warning("disk", "nearly full", "free it"),
                                         failure("clock", "another", "lcm.clock = \"realtime\""),
                                         notLookedAt("devices", "none")};
  EXPECT_EQ(toText(findings),
            "ok             rates              10 ms\n"
            "warn           disk               nearly full\n"
            "                                  -> free it\n"
            "FAIL           clock              another\n"
            "                                  -> lcm.clock = \"realtime\"\n"
            "not looked at  devices            none\n"
            "1 ok, 1 to know, 1 to mend, 1 not looked at\n");
}

TEST(Finding, OnlyFailuresAreFailures) {
  EXPECT_FALSE(anyFailure({}));
  EXPECT_FALSE(anyFailure(std::vector{ok("a", ""), warning("b", "", ""), notLookedAt("c", "")}));
  EXPECT_TRUE(anyFailure(std::vector{ok("a", ""), failure("b", "", "")}));
}

}  // namespace
}  // namespace nanomap::doctor
