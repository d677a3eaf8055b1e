#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/camera_model.h"
#include "core/depth_image.h"

namespace nanomap {

/// The least and the greatest raw depth of each square tile of a depth image, roughly the greatest of each of its
/// columns, and which of its pixels carry none: enough to tell, for most pixels, that nothing there is nearer or
/// farther than a limit. Threads: any number of readers; assigning needs the tiles alone.
class DepthTiles {
 public:
  static constexpr int kEdge_px = 8;  ///< tiles at the right and bottom border may be cut
  static constexpr std::uint16_t kNoDepth = 65535;

  /// Of an image without any depth. Allocates; nothing else does.
  explicit DepthTiles(const CameraModel& camera);

  /// @pre the image has the camera's size. Allocates.
  DepthTiles(const DepthImage& image, const CameraModel& camera) : DepthTiles(camera) { assign(image, camera); }

  /// Bounds of another image. @pre it has the camera's size, and the camera the size of the first one
  void assign(const DepthImage& image, const CameraModel& camera);

  [[nodiscard]] int columns() const { return columns_; }
  [[nodiscard]] int rows() const { return rows_; }

  /// Row-major, `columns() * rows()` values. A tile without any depth holds kNoDepth.
  [[nodiscard]] const std::vector<std::uint16_t>& least() const { return least_; }

  /// What is in front of whatever is not nearer: all pixels of a tile but those that carry no depth. Depths are rounded
  /// up, to make it so small that those of all views of a history stay in a near cache.
  struct Cover {
    /// The bits of a pixel's column and row in its tile.
    [[nodiscard]] static constexpr std::uint32_t linesOf(int column, int row) {
      return std::uint32_t{kFirstColumn} << column | std::uint32_t{kFirstRow} << row;
    }
    static constexpr int kDepthBits = 12;
    static constexpr int kBitsRounded = 16 - kDepthBits;  ///< of a raw depth: up to the next that has them all set
    static constexpr int kStepBits = 4;
    static constexpr std::uint32_t kFirstColumn = 1U << (kDepthBits + kStepBits);
    static constexpr std::uint32_t kFirstRow = kFirstColumn << kEdge_px;
    static constexpr int kBitsOfColumn = 4;
    static constexpr std::uint32_t kMostSteps = (1U << kBitsOfColumn) - 1;

    /// No less than any raw depth.
    [[nodiscard]] std::uint16_t greatest() const {
      return static_cast<std::uint16_t>(bits << kBitsRounded | ((1U << kBitsRounded) - 1));
    }
    /// No less than any raw depth in a column: what is upright (trunks, poles, frames of doors) parts near from far
    /// along columns. Of a column without any depth it says nothing.
    [[nodiscard]] std::uint16_t greatestOfColumn(int column) const {
      const std::uint32_t count = steps >> (column * kBitsOfColumn) & kMostSteps;
      return static_cast<std::uint16_t>(greatest() - (count << stepShift()));
    }
    /// Of two, what power a step is: the least that reaches from greatest() down to each column in kMostSteps.
    [[nodiscard]] std::uint32_t stepShift() const { return bits >> kDepthBits & ((1U << kStepBits) - 1); }
    /// linesOf() all pixels that carry no depth: another one may have its column of one of them and its row of another,
    /// but most carry a depth for certain where gaps are few. Of lines outside the image they say nothing.
    [[nodiscard]] std::uint32_t gapLines() const { return bits & ~(kFirstColumn - 1); }

    std::uint32_t bits = ~(kFirstColumn - 1);  ///< the greatest's first bits, those of stepShift(), and gapLines()
    std::uint32_t steps = 0;                   ///< of each column, kBitsOfColumn each, left to right
  };

  /// In the same order.
  [[nodiscard]] const std::vector<Cover>& cover() const { return cover_; }

  /// Is there a pixel in the tile that carries no depth?
  [[nodiscard]] bool hasGap(std::size_t tile) const { return cover_[tile].gapLines() != 0; }

  /// The pixels of a tile that carry no depth: a byte for each column, a bit for each row.
  using Gaps = std::array<std::uint8_t, kEdge_px>;
  /// The same order as above.
  [[nodiscard]] const std::vector<Gaps>& gaps() const { return gaps_; }

  [[nodiscard]] std::size_t tileAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

 private:
  int columns_;
  int rows_;
  std::vector<std::uint16_t> least_;
  std::vector<Cover> cover_;
  std::vector<Gaps> gaps_;
};

}  // namespace nanomap
