#include "drivers/lcm/convert.h"

#include <cassert>

namespace nanomap {
namespace {

using Microseconds = std::chrono::duration<std::int64_t, std::micro>;

/// core/time.h: the difference of any two stamps must fit.
constexpr Duration kLatestStamp{std::int64_t{1} << 62};
constexpr std::int64_t kLatestUtime_us = std::chrono::floor<Microseconds>(kLatestStamp).count();

}  // namespace

std::string_view toString(ConvertFault fault) {
  switch (fault) {
    case ConvertFault::kBadStamp:
      return "stamp out of range";
    case ConvertFault::kBadSequence:
      return "negative sequence number";
    case ConvertFault::kBadEpoch:
      return "negative epoch";
    case ConvertFault::kBadSize:
      return "image size out of range";
    case ConvertFault::kSizeMismatch:
      return "data of another size than the image";
    case ConvertFault::kUnknownCompression:
      return "unknown compression";
    case ConvertFault::kUnknownPixelFormat:
      return "pixel format is not 16-bit grey";
    case ConvertFault::kBadCompressedData:
      return "damaged compressed data";
    case ConvertFault::kNoDepthImage:
      return "no depth image among the images";
    case ConvertFault::kBadNoReturnValue:
      return "no-return value is not a 16-bit value";
  }
  return "?";
}

Converted<Time> timeFromUtime(std::int64_t utime_us) {
  if (utime_us < 0 || utime_us > kLatestUtime_us) return ConvertFault::kBadStamp;
  return Time(Microseconds(utime_us));
}

std::int64_t utimeFromTime(Time time) {
  assert(time >= Time{});
  return std::chrono::floor<Microseconds>(time.time_since_epoch()).count();
}

}  // namespace nanomap
