#include "tools/import/numbered_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kTurnedPose =
    "0.0 -1.0 0.0 1.5\n"
    "1.0 0.0 0.0 -2.0\n"
    "0.0 0.0 1.0 0.25\n"
    "0.0 0.0 0.0 1.0\n";

class NumberedLayoutTest : public testing::Test {
 protected:
  void frame(const std::string& number, const std::string& pose = kTurnedPose) {
    folder_.write(number + ".depth.png", "read later");
    folder_.write(number + ".pose.txt", pose);
  }
  void expectFault(const std::string& file, const std::string& fault) {
    EXPECT_THAT([&] { (void)readNumberedLayout(folder_.path(), 30.0); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(file), HasSubstr(fault))));
  }
  TemporaryFolder folder_;
};

TEST_F(NumberedLayoutTest, StampsByNumberInOrder) {
  for (const char* number : {"000031", "000000", "000002"}) frame(number);
  folder_.write("README.md", "not a frame");
  folder_.write("x.depth.png", "not a number");
  const Recording recording = readNumberedLayout(folder_.path(), 30.0);
  ASSERT_EQ(recording.images.size(), 3U);
  ASSERT_EQ(recording.poses.size(), 3U);
  EXPECT_EQ(toNanoseconds(recording.images[0].stamp), 0);
  EXPECT_EQ(toNanoseconds(recording.images[1].stamp), 66'666'667);
  EXPECT_EQ(toNanoseconds(recording.images[2].stamp), 1'033'333'333);
  EXPECT_EQ(recording.images[2].sequence, 31U);
  EXPECT_EQ(recording.images[2].file.filename(), "000031.depth.png");
  EXPECT_EQ(recording.poses[2].stamp, recording.images[2].stamp);
}

TEST_F(NumberedLayoutTest, ReadsCameraToWorld) {
  frame("000000");
  const Pose T_W_C = readNumberedLayout(folder_.path(), 30.0).poses[0].T_W_C;
  EXPECT_LT((T_W_C * Vec3(1.0, 0.0, 0.0) - Vec3(1.5, -1.0, 0.25)).norm(), 1e-15);
}

TEST_F(NumberedLayoutTest, NamesEmptyFolder) { expectFault(folder_.path().string(), "no NNNNNN.depth.png"); }

TEST_F(NumberedLayoutTest, NamesMissingPose) {
  frame("000000");
  folder_.write("000001.depth.png", "");
  expectFault("000001.pose.txt", "cannot be read");
}

TEST_F(NumberedLayoutTest, NamesRepeatedNumber) {
  frame("000001");
  frame("1");
  expectFault("000001.depth.png", "same number");
}

TEST_F(NumberedLayoutTest, NamesMalformedMatrix) {
  frame("000000", "1 0 0 0\n0 1 0 0\n0 0 1 0\n");
  expectFault("000000.pose.txt", "3 rows");
  frame("000000", "1 0 0 0\n0 1 0\n0 0 1 0\n0 0 0 1\n");
  expectFault("000000.pose.txt:2", "4 rows of 4");
  frame("000000", std::string(kTurnedPose) + "0 0 0 1\n");
  expectFault("000000.pose.txt:5", "4 rows of 4");
  frame("000000", "1 0 0 zero\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  expectFault("000000.pose.txt:1", "'zero' is not a number");
}

TEST_F(NumberedLayoutTest, NamesNonFiniteAndNonRigid) {
  frame("000000", "nan 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  expectFault("000000.pose.txt:1", "'nan' is not finite");
  frame("000000", "2 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0 1\n");
  expectFault("000000.pose.txt", "not a rotation");
  frame("000000", "1 0 0 0\n0 1 0 0\n0 0 -1 0\n0 0 0 1\n");
  expectFault("000000.pose.txt", "mirrors");
  frame("000000", "1 0 0 0\n0 1 0 0\n0 0 1 0\n0 0 0.5 1\n");
  expectFault("000000.pose.txt", "last row");
}

}  // namespace
}  // namespace nanomap
