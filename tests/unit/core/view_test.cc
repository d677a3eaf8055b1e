#include "core/view.h"

#include <gtest/gtest.h>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::model;
using test::smallCamera;

ImageFault faultOf(DepthImage image) { return std::get<ImageFault>(buildView(std::move(image), model(smallCamera()))); }

TEST(BuildView, NamesWhatIsWrongWithAnImage) {
  const CameraModel camera(smallCamera());
  EXPECT_EQ(faultOf(DepthImage{}), ImageFault::kEmpty);

  DepthImage truncated = flatImage(camera, 1000);
  truncated.pixels.pop_back();
  EXPECT_EQ(faultOf(truncated), ImageFault::kTruncated);

  EXPECT_EQ(faultOf(flatImage(CameraModel(smallCamera(32, 24)), 1000)), ImageFault::kSizeMismatch);

  DepthImage transposed = flatImage(camera, 1000);
  std::swap(transposed.width_px, transposed.height_px);
  EXPECT_EQ(faultOf(transposed), ImageFault::kSizeMismatch);

  DepthImage unit = flatImage(camera, 1000);
  unit.depth_unit_m = 0.0001;
  EXPECT_EQ(faultOf(unit), ImageFault::kUnitMismatch);
  unit.depth_unit_m = 0.0;
  EXPECT_EQ(faultOf(unit), ImageFault::kUnitMismatch);
}

TEST(BuildView, IndexesTheReturnsInRangeAndNothingElse) {
  const auto camera = model(smallCamera());
  DepthImage image = flatImage(*camera, 0);
  image.pixels[0] = 1000;
  image.pixels[1] = 100;    // too near
  image.pixels[2] = 20000;  // too far
  image.pixels[3] = 65535;  // no return
  const ViewPtr view = test::viewOf(image, camera);
  EXPECT_EQ(view->index().size(), 1U);
  Neighbour found;
  EXPECT_EQ(view->index().nearest(Vec3f::Zero(), {&found, 1}), 1U);
  EXPECT_EQ(found.point_C, camera->deproject(0, 1000));
}

}  // namespace
}  // namespace nanomap
