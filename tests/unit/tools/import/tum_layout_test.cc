#include "tools/import/tum_layout.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/temporary_folder.h"

namespace nanomap {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

constexpr const char* kImages =
    "# depth maps\n# timestamp filename\n"
    "1305031102.160407 depth/1305031102.160407.png\n1305031102.194330 depth/1305031102.194330.png\n";
constexpr const char* kPoses =
    "# timestamp tx ty tz qx qy qz qw\n"
    "1305031102.1559 1.0 -2.0 0.5 0.0 0.0 0.7071 0.7071\n1305031102.1658 1.1 -2.0 0.5 0.0 0.0 0.0 1.0\n";

class TumLayoutTest : public testing::Test {
 protected:
  void write(const std::string& images, const std::string& poses) {
    folder_.write("depth.txt", images);
    folder_.write("groundtruth.txt", poses);
  }
  void expectFault(const std::string& file, const std::string& fault) {
    EXPECT_THAT([&] { (void)readTumLayout(folder_.path()); },
                ThrowsMessage<std::runtime_error>(AllOf(HasSubstr(file), HasSubstr(fault))));
  }
  TemporaryFolder folder_;
};

TEST_F(TumLayoutTest, IsRecognisedByItsTwoLists) {
  EXPECT_FALSE(isTumLayout(folder_.path()));
  folder_.write("depth.txt", kImages);
  EXPECT_FALSE(isTumLayout(folder_.path()));
  folder_.write("groundtruth.txt", kPoses);
  EXPECT_TRUE(isTumLayout(folder_.path()));
}

TEST_F(TumLayoutTest, ReadsStampsFilesAndPoses) {
  write(kImages, kPoses);
  const Recording recording = readTumLayout(folder_.path());
  ASSERT_EQ(recording.images.size(), 2U);
  EXPECT_EQ(toNanoseconds(recording.images[0].stamp), 1'305'031'102'160'407'000);
  EXPECT_EQ(recording.images[1].sequence, 1U);
  EXPECT_EQ(recording.images[1].file, folder_.path() / "depth/1305031102.194330.png");
  ASSERT_EQ(recording.poses.size(), 2U);
  EXPECT_EQ(toNanoseconds(recording.poses[0].stamp), 1'305'031'102'155'900'000);
}

TEST_F(TumLayoutTest, TakesQuaternionWithScalarLastAndNormalises) {
  write(kImages, kPoses);
  const Pose T_W_C = readTumLayout(folder_.path()).poses[0].T_W_C;
  EXPECT_NEAR(T_W_C.rotation.norm(), 1.0, 1e-15);
  EXPECT_LT((T_W_C * Vec3(1.0, 0.0, 0.0) - Vec3(1.0, -1.0, 0.5)).norm(), 1e-9);
}

TEST_F(TumLayoutTest, NamesMissingAndEmptyLists) {
  folder_.write("groundtruth.txt", kPoses);
  expectFault("depth.txt", "cannot be read");
  write("# nothing\n", kPoses);
  expectFault("depth.txt", "no records");
  write(kImages, "");
  expectFault("groundtruth.txt", "no records");
}

TEST_F(TumLayoutTest, NamesTimeGoingBackwardsAndDuplicates) {
  write("2.0 b.png\n1.0 a.png\n", kPoses);
  expectFault("depth.txt:2", "stamp 1.0 does not increase");
  write(kImages, "1.0 0 0 0 0 0 0 1\n1.0 0 0 0 0 0 0 1\n");
  expectFault("groundtruth.txt:2", "stamp 1.0 does not increase");
}

TEST_F(TumLayoutTest, NamesMalformedRecords) {
  write("1.0\n", kPoses);
  expectFault("depth.txt:1", "stamp file");
  write(kImages, "1.0 0 0 0 0 0 0\n");
  expectFault("groundtruth.txt:1", "qx qy qz qw");
  write(kImages, "1.0 0 nan 0 0 0 0 1\n");
  expectFault("groundtruth.txt:1", "'nan' is not finite");
  write(kImages, "1.0 0 0 0 0 0 0 0.5\n");
  expectFault("groundtruth.txt:1", "norm 0.5");
}

}  // namespace
}  // namespace nanomap
