#include "tools/import/numbered_layout.h"

#include <fmt/format.h>

#include <cassert>
#include <charconv>
#include <map>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "tools/import/rotation.h"
#include "tools/import/text_fields.h"

namespace nanomap {
namespace {

constexpr std::string_view kImageSuffix = ".depth.png";
constexpr std::string_view kPoseSuffix = ".pose.txt";
/// What rounding may leave in the last row of a rigid transform, which is 0 0 0 1.
constexpr double kMaxLastRowError = 1e-6;

/// The number in `NNNNNN.depth.png`; empty for any other name.
std::optional<std::uint64_t> frameNumber(std::string_view name) {
  if (!name.ends_with(kImageSuffix)) return std::nullopt;
  name.remove_suffix(kImageSuffix.size());
  std::uint64_t number = 0;
  const auto [stop, error] = std::from_chars(name.data(), name.data() + name.size(), number);
  if (error != std::errc() || stop != name.data() + name.size()) return std::nullopt;
  return number;
}

std::filesystem::path poseFileOf(const std::filesystem::path& image) {
  std::string name = image.filename().string();
  name.resize(name.size() - kImageSuffix.size());
  return image.parent_path() / name.append(kPoseSuffix);
}

Pose readPoseMatrix(const std::filesystem::path& file) {
  Eigen::Matrix4d T;
  int rows = 0;
  forEachRecord(file, [&](std::span<const std::string_view> fields) {
    if (fields.size() != 4 || rows == 4) throw std::invalid_argument("a pose is 4 rows of 4 numbers");
    for (int column = 0; column < 4; ++column) T(rows, column) = parseNumber(fields[static_cast<std::size_t>(column)]);
    ++rows;
  });
  if (rows != 4) throw std::runtime_error(fmt::format("{}: {} rows, but a pose has 4", file.string(), rows));
  if ((T.row(3) - Eigen::RowVector4d(0.0, 0.0, 0.0, 1.0)).cwiseAbs().maxCoeff() > kMaxLastRowError) {
    throw std::runtime_error(fmt::format("{}: the last row is not 0 0 0 1", file.string()));
  }
  try {
    return {nearestRotation(T.topLeftCorner<3, 3>()), T.topRightCorner<3, 1>()};
  } catch (const std::invalid_argument& error) {
    throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
  }
}

}  // namespace

Recording readNumberedLayout(const std::filesystem::path& folder, double rate_hz) {
  assert(rate_hz > 0.0);
  std::map<std::uint64_t, std::filesystem::path> images;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    const std::optional<std::uint64_t> number = frameNumber(entry.path().filename().string());
    if (!number) continue;
    if (const auto [same, fresh] = images.emplace(*number, entry.path()); !fresh) {
      throw std::runtime_error(
          fmt::format("{} and {} have the same number", same->second.string(), entry.path().string()));
    }
  }
  if (images.empty()) throw std::runtime_error(fmt::format("{}: no NNNNNN.depth.png in it", folder.string()));

  Recording recording;
  for (const auto& [number, file] : images) {
    const Time stamp = Time(fromSeconds(static_cast<double>(number) / rate_hz));
    recording.poses.push_back({stamp, readPoseMatrix(poseFileOf(file))});
    recording.images.push_back({stamp, number, file});
  }
  return recording;
}

}  // namespace nanomap
