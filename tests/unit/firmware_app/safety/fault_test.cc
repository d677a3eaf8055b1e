#include "firmware_app/safety/fault.h"

#include <gtest/gtest.h>

#include <set>

namespace nanomap {
namespace {

TEST(FaultSet, NamesWhatItHoldsInOrder) {
  FaultSet faults;
  EXPECT_FALSE(faults.any());
  EXPECT_EQ(faults.words(), "");
  faults.add(Fault::kPlan);
  faults.add(Fault::kDepth);
  EXPECT_TRUE(faults.any());
  EXPECT_TRUE(faults.has(Fault::kDepth));
  EXPECT_FALSE(faults.has(Fault::kPose));
  EXPECT_EQ(faults.words(), "depth images, a plan");
}

TEST(FaultSet, EveryFaultHasWordsOfItsOwn) {
  std::set<std::string_view> words;
  for (std::size_t i = 0; i < kFaultCount; ++i) words.insert(toString(static_cast<Fault>(i)));
  EXPECT_EQ(words.size(), kFaultCount);
  EXPECT_FALSE(words.contains("?"));
}

}  // namespace
}  // namespace nanomap
