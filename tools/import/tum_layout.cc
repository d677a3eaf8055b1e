#include "tools/import/tum_layout.h"

#include <fmt/format.h>

#include <stdexcept>

#include "tools/import/rotation.h"
#include "tools/import/text_fields.h"

namespace nanomap {
namespace {

constexpr const char* kImageList = "depth.txt";
constexpr const char* kPoseList = "groundtruth.txt";

template <class Record>
Time nextStamp(std::string_view text, const std::vector<Record>& before) {
  const Time stamp = parseStamp(text);
  if (!before.empty() && stamp <= before.back().stamp) {
    throw std::invalid_argument(fmt::format("stamp {} does not increase: sort the lines, drop repeated ones", text));
  }
  return stamp;
}

void requireRecords(std::size_t count, const std::filesystem::path& file) {
  if (count == 0) throw std::runtime_error(fmt::format("{}: no records in it", file.string()));
}

std::vector<RecordedImage> readImageList(const std::filesystem::path& file) {
  std::vector<RecordedImage> images;
  forEachRecord(file, [&](std::span<const std::string_view> fields) {
    if (fields.size() != 2) throw std::invalid_argument("a line is 'stamp file'");
    images.push_back({nextStamp(fields[0], images), images.size(), file.parent_path() / fields[1]});
  });
  requireRecords(images.size(), file);
  return images;
}

std::vector<RecordedPose> readPoseList(const std::filesystem::path& file) {
  std::vector<RecordedPose> poses;
  forEachRecord(file, [&](std::span<const std::string_view> fields) {
    if (fields.size() != 8) throw std::invalid_argument("a line is 'stamp tx ty tz qx qy qz qw'");
    const auto number = [&fields](std::size_t i) { return parseNumber(fields[i]); };
    const Quat rotation = unitQuaternion(Quat(number(7), number(4), number(5), number(6)));
    poses.push_back({nextStamp(fields[0], poses), {rotation, {number(1), number(2), number(3)}}});
  });
  requireRecords(poses.size(), file);
  return poses;
}

}  // namespace

Recording readTumLayout(const std::filesystem::path& folder) {
  return {readPoseList(folder / kPoseList), readImageList(folder / kImageList)};
}

bool isTumLayout(const std::filesystem::path& folder) {
  return std::filesystem::exists(folder / kImageList) && std::filesystem::exists(folder / kPoseList);
}

}  // namespace nanomap
