#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "core/camera_model.h"
#include "core/chain.h"
#include "core/depth_image.h"
#include "core/nearest_point_index.h"

namespace nanomap::bench {

/// A depth frame as it was measured, with a k-d tree of its points.
struct IndexedFrame {
  const DepthImage* image = nullptr;
  const CameraModel* camera = nullptr;
  std::unique_ptr<const NearestPointIndex> index;
};

/// NanoMap as its paper tells it (Algorithm 1): from the newest view to the oldest, a point and its full covariance are
/// carried over one edge after another in double precision, the box is tested against the frustum and the mean against
/// its pixel; the first view that passes answers from its tree, the newest one if none does.
/// It says nothing about a view that does not pass, and knows no sky: a pixel without depth does not pass.
/// Rotations are matrices, made when the chain is. Allocates: no, but for what the tree does. Borrows images and
/// cameras.
class SequentialChain {
 public:
  /// @param edges   newest first: edge i leads from view i - 1 (the body, for the first) to view i
  /// @param frames  newest first; those that no query ends at need no index. @pre as many as edges, one or more
  SequentialChain(std::span<const Edge> edges, std::vector<IndexedFrame> frames);

  /// The most recent view that contains the point; empty if none does.
  [[nodiscard]] std::optional<std::uint32_t> locate(const UncertainPoint& x_B) const;

  struct Answer {
    std::optional<std::uint32_t> view;
    std::size_t neighbour_count = 0;
    std::array<Neighbour, kMaxNeighbours> neighbours;  ///< in that view's camera frame, else the newest's
  };
  [[nodiscard]] Answer query(const UncertainPoint& x_B, int k) const;

  /// Another frame in place of the newest, with the same edges: the part of an insertion that takes time.
  void replaceNewest(IndexedFrame frame) { links_.front().frame = std::move(frame); }

 private:
  struct Link {
    Mat3 R_older_newer;
    Vec3 t_older_newer_m;
    Mat3 covariance_older_m2;
    IndexedFrame frame;
  };
  struct Walk {
    std::optional<std::uint32_t> view;
    Vec3 mean_C_m;  ///< in that view's camera frame, else the newest's
  };
  [[nodiscard]] Walk walk(const UncertainPoint& x_B) const;

  std::vector<Link> links_;
};

}  // namespace nanomap::bench
