#include "core/view_pool.h"

#include <gtest/gtest.h>

#include <thread>

#include "tests/support/drawing.h"

namespace nanomap {
namespace {

using test::flatImage;
using test::model;
using test::smallCamera;

/// Distance along the optical axis from the camera to what `view` saw, asked of its pixels and of its index.
float depthSeen(const View& view) {
  Neighbour found;
  EXPECT_EQ(view.index().nearest(Vec3f::Zero(), {&found, 1}), 1U);
  EXPECT_EQ(found.point_C.z(), view.camera().depth(view.rawAt(10, 20)));
  EXPECT_EQ(view.tiles().least().front(), view.rawAt(10, 20));
  return found.point_C.z();
}

class ViewPoolOf : public testing::TestWithParam<IndexKind> {
 protected:
  ViewPtr build(ViewPool& pool, std::uint16_t raw) { return std::get<ViewPtr>(pool.build(flatImage(*camera_, raw))); }

  std::shared_ptr<const CameraModel> camera_ = model(smallCamera());
};

TEST_P(ViewPoolOf, ReusesAViewThatWasLetGoAndNoOther) {
  ViewPool pool(camera_, GetParam(), 2);
  ViewPtr first = build(pool, 1000);
  const ViewPtr second = build(pool, 2000);
  EXPECT_EQ(pool.capacity(), 2U);
  const View* storage = first.get();
  first.reset();
  const ViewPtr third = build(pool, 3000);
  EXPECT_EQ(third.get(), storage);
  EXPECT_EQ(pool.capacity(), 2U);
  EXPECT_FLOAT_EQ(depthSeen(*second), 2.0F);
  EXPECT_FLOAT_EQ(depthSeen(*third), 3.0F);
}

TEST_P(ViewPoolOf, GrowsWhileAllViewsAreInUse) {
  ViewPool pool(camera_, GetParam(), 0);
  std::vector<ViewPtr> held;
  for (std::uint16_t raw = 1000; raw <= 5000; raw += 1000) held.push_back(build(pool, raw));
  EXPECT_EQ(pool.capacity(), 5U);
  for (std::size_t i = 0; i < held.size(); ++i) EXPECT_FLOAT_EQ(depthSeen(*held[i]), static_cast<float>(i + 1));
}

TEST_P(ViewPoolOf, KeepsAViewWhileAnyOwnerIsLeft) {
  ViewPool pool(camera_, GetParam(), 1);
  const std::weak_ptr<const View> watcher = [&] {
    const ViewPtr view = build(pool, 1000);
    const ViewPtr copy = view;  // NOLINT(performance-unnecessary-copy-initialization): a second owner
    EXPECT_NE(build(pool, 2000).get(), view.get());
    return std::weak_ptr<const View>(copy);
  }();
  EXPECT_TRUE(watcher.expired());
  EXPECT_EQ(pool.capacity(), 2U);
}

TEST_P(ViewPoolOf, ViewsOutliveIt) {
  ViewPtr view;
  {
    ViewPool pool(camera_, GetParam(), 1);
    view = build(pool, 4000);
  }
  EXPECT_FLOAT_EQ(depthSeen(*view), 4.0F);
}

TEST_P(ViewPoolOf, RefusesWhatIsNoImageOfItsCamera) {
  ViewPool pool(camera_, GetParam(), 1);
  EXPECT_EQ(std::get<ImageFault>(pool.build(DepthImage{})), ImageFault::kEmpty);
  EXPECT_EQ(std::get<ImageFault>(pool.build(flatImage(CameraModel(smallCamera(32, 24)), 1000))),
            ImageFault::kSizeMismatch);
  EXPECT_FLOAT_EQ(depthSeen(*build(pool, 1000)), 1.0F);
}

/// A race between the last reader and the builder would be seen by ThreadSanitizer.
TEST_P(ViewPoolOf, TakesBackViewsFromOtherThreads) {
  constexpr int kFrames = 200;
  ViewPool pool(camera_, GetParam(), 2);
  for (int i = 1; i <= kFrames; ++i) {
    const auto raw = static_cast<std::uint16_t>(1000 + i);
    std::thread reader([view = build(pool, raw), raw]() mutable {
      EXPECT_EQ(view->rawAt(3, 3), raw);
      view.reset();
    });
    if (i % 2 == 0) (void)build(pool, 500);
    reader.join();
  }
  EXPECT_LE(pool.capacity(), 3U);
}

INSTANTIATE_TEST_SUITE_P(Index, ViewPoolOf, testing::Values(IndexKind::kImage, IndexKind::kFlann));

}  // namespace
}  // namespace nanomap
