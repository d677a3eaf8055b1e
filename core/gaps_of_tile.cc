#include "core/gaps_of_tile.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>

namespace nanomap {
namespace {

constexpr int kEdge_px = DepthTiles::kEdge_px;

/// Eight lines of eight pixels, a byte a line. Transposing makes rows of columns.
using Lines = std::uint64_t;

Lines transposed(Lines lines) {
  // Swaps ever larger squares across the diagonal (Warren, Hacker's Delight, 7-3).
  const auto swap = [&lines](int shift, Lines mask) {
    const Lines difference = (lines ^ (lines >> shift)) & mask;
    lines ^= difference ^ (difference << shift);
  };
  swap(7, 0x00AA00AA00AA00AA);
  swap(14, 0x0000CCCC0000CCCC);
  swap(28, 0x00000000F0F0F0F0);
  return lines;
}

/// Columns of a tile; what lies outside the image counts as without depth.
Lines gapColumns(const View& view, int column, int row) {
  constexpr Lines kAll = ~Lines{0};
  const DepthTiles& tiles = view.tiles();
  if (column < 0 || column >= tiles.columns() || row < 0 || row >= tiles.rows()) return kAll;
  const DepthTiles::Gaps& gaps = tiles.gaps()[tiles.tileAt(column, row)];
  const int columns = std::min(view.camera().width() - column * kEdge_px, kEdge_px);
  const int rows = std::min(view.camera().height() - row * kEdge_px, kEdge_px);
  const auto outside_rows = static_cast<std::uint8_t>(0xFFU << rows);
  Lines lines = 0;
  for (int u = 0; u < kEdge_px; ++u) {
    const std::uint8_t line = u < columns ? gaps[static_cast<std::size_t>(u)] | outside_rows : std::uint8_t{0xFF};
    lines |= Lines{line} << (u * kEdge_px);
  }
  return lines;
}

template <class Line>
void join(Lines before, Lines at, Lines after, std::array<Line, kEdge_px>& out) {
  for (std::size_t i = 0; i < out.size(); ++i) {
    const auto line = [shift = static_cast<int>(i) * kEdge_px](Lines lines) {
      return static_cast<Line>(lines >> shift & 0xFFU);
    };
    out[i] = line(before) | line(at) << kEdge_px | line(after) << (2 * kEdge_px);
  }
}

struct Gap {
  int before;  ///< steps from the pixel to the end
  int after;
};

/// The gap around pixel `i` of a line, with its ends outside of it.
Gap gapAround(std::uint32_t line, int i) {
  const int bit = kEdge_px + i;
  const auto highest = std::countl_one(line << (31 - bit));
  return {highest, std::countr_one(line >> bit)};
}

}  // namespace

GapsOfTile::GapsOfTile(const View& view, int column, int row) : view_(view) {
  const Lines at = gapColumns(view, column, row);
  join(gapColumns(view, column, row - 1), at, gapColumns(view, column, row + 1), columns_);
  join(transposed(gapColumns(view, column - 1, row)), transposed(at), transposed(gapColumns(view, column + 1, row)),
       rows_);
}

std::optional<float> GapsOfTile::narrowDepth_m(CameraModel::Pixel pixel, int widest_px) const {
  assert(widest_px <= kWidest_px);
  const int u = pixel.u % kEdge_px;
  const int v = pixel.v % kEdge_px;
  const auto depthAt = [&](int at_u, int at_v) { return view_.camera().depth(view_.rawAt(at_u, at_v)); };
  std::optional<float> nearest_m;
  const auto add = [&](float one_m, float other_m) {
    const float end_m = std::min(one_m, other_m);
    nearest_m = nearest_m ? std::min(*nearest_m, end_m) : end_m;
  };
  const auto isNarrow = [&](const Gap& gap) { return gap.before + gap.after - 1 <= widest_px; };
  if (const Gap gap = gapAround(rows_[static_cast<std::size_t>(v)], u); isNarrow(gap)) {
    add(depthAt(pixel.u - gap.before, pixel.v), depthAt(pixel.u + gap.after, pixel.v));
  }
  if (const Gap gap = gapAround(columns_[static_cast<std::size_t>(u)], v); isNarrow(gap)) {
    add(depthAt(pixel.u, pixel.v - gap.before), depthAt(pixel.u, pixel.v + gap.after));
  }
  return nearest_m;
}

}  // namespace nanomap
