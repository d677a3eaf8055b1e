#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "drivers/lcm/convert.h"
#include "drivers/lcm/depth_codec.h"

namespace nanomap {
namespace {

static_assert(std::endian::native == std::endian::little, "pixels in messages are little-endian");

constexpr std::size_t kPixelBytes = sizeof(std::uint16_t);

/// bot_core's DEPTH_MM.
constexpr double kBotCoreDepthUnit_m = 0.001;

/// Most that deflate can shrink anything (zlib's technical page): a smaller stream cannot hold the image.
constexpr std::size_t kMaxDeflateRatio = 1032;

using Pixels = std::vector<std::uint16_t>;

/// Stamp, size and sequence number of an image, checked; `pixels` still empty.
Converted<DepthImage> imageHeader(std::int64_t utime_us, std::uint64_t sequence, std::int32_t width_px,
                                  std::int32_t height_px, double depth_unit_m) {
  const Converted<Time> stamp = timeFromUtime(utime_us);
  if (const auto* fault = std::get_if<ConvertFault>(&stamp)) return *fault;
  if (!isImageSize(width_px, height_px)) return ConvertFault::kBadSize;
  DepthImage image;
  image.stamp = std::get<Time>(stamp);
  image.sequence = sequence;
  image.width_px = width_px;
  image.height_px = height_px;
  image.depth_unit_m = depth_unit_m;
  return image;
}

std::size_t pixelCount(const DepthImage& image) {
  return static_cast<std::size_t>(image.width_px) * static_cast<std::size_t>(image.height_px);
}

Converted<Pixels> rawPixels(Bytes data, std::size_t count) {
  if (data.size() != count * kPixelBytes) return ConvertFault::kSizeMismatch;
  Pixels pixels(count);
  if (count > 0) std::memcpy(pixels.data(), data.data(), data.size());
  return pixels;
}

Converted<Pixels> bloscPixels(Bytes data, std::size_t count) {
  const std::optional<std::size_t> announced = compressedPixelCount(data);
  if (!announced) return ConvertFault::kBadCompressedData;
  if (*announced != count) return ConvertFault::kSizeMismatch;
  Pixels pixels(count);
  if (!decompressDepth(data, pixels)) return ConvertFault::kBadCompressedData;
  return pixels;
}

/// Rows of `row_stride` bytes without what pads them.
Converted<Pixels> stridedPixels(Bytes data, const DepthImage& image, std::int32_t row_stride) {
  const std::size_t row_bytes = static_cast<std::size_t>(image.width_px) * kPixelBytes;
  const auto rows = static_cast<std::size_t>(image.height_px);
  if (row_stride < 0 || static_cast<std::size_t>(row_stride) < row_bytes) return ConvertFault::kSizeMismatch;
  const auto stride = static_cast<std::size_t>(row_stride);
  if (data.size() != stride * rows) return ConvertFault::kSizeMismatch;
  Pixels pixels(pixelCount(image));
  if (pixels.empty()) return pixels;
  for (std::size_t row = 0; row < rows; ++row) {
    std::memcpy(pixels.data() + row * (row_bytes / kPixelBytes), data.data() + row * stride, row_bytes);
  }
  return pixels;
}

/// A zlib stream of exactly `size` bytes.
Converted<std::vector<std::uint8_t>> inflated(Bytes data, std::size_t size) {
  if (size / kMaxDeflateRatio > data.size()) return ConvertFault::kSizeMismatch;
  std::vector<std::uint8_t> plain(size);
  uLongf plain_size = plain.size();
  if (uncompress(plain.data(), &plain_size, data.data(), data.size()) != Z_OK) return ConvertFault::kBadCompressedData;
  if (plain_size != size) return ConvertFault::kSizeMismatch;
  return plain;
}

Converted<Pixels> zippedPixels(Bytes data, const DepthImage& image, std::int32_t row_stride) {
  if (row_stride < 0) return ConvertFault::kSizeMismatch;
  const std::size_t size = static_cast<std::size_t>(row_stride) * static_cast<std::size_t>(image.height_px);
  if (size > kMaxImagePixels * kPixelBytes) return ConvertFault::kBadSize;
  const Converted<std::vector<std::uint8_t>> plain = inflated(data, size);
  if (const auto* fault = std::get_if<ConvertFault>(&plain)) return *fault;
  return stridedPixels(std::get<std::vector<std::uint8_t>>(plain), image, row_stride);
}

Converted<DepthImage> withPixels(DepthImage image, Converted<Pixels> pixels) {
  if (const auto* fault = std::get_if<ConvertFault>(&pixels)) return *fault;
  image.pixels = std::get<Pixels>(std::move(pixels));
  return image;
}

}  // namespace

Converted<DepthImage> toDepthImage(const depth_image_t& message) {
  if (message.sequence < 0) return ConvertFault::kBadSequence;
  Converted<DepthImage> header = imageHeader(message.utime, static_cast<std::uint64_t>(message.sequence), message.width,
                                             message.height, message.depth_unit);
  if (std::holds_alternative<ConvertFault>(header)) return header;
  auto& image = std::get<DepthImage>(header);
  const std::size_t count = pixelCount(image);
  switch (message.compression) {
    case depth_image_t::RAW:
      return withPixels(std::move(image), rawPixels(message.data, count));
    case depth_image_t::BLOSC:
      return withPixels(std::move(image), bloscPixels(message.data, count));
    default:
      return ConvertFault::kUnknownCompression;
  }
}

Converted<DepthImage> toDepthImage(const bot_core::images_t& message, std::uint64_t sequence) {
  const auto& types = message.image_types;
  const auto type = std::find_if(types.begin(), types.end(), [](std::int16_t candidate) {
    return candidate == bot_core::images_t::DEPTH_MM || candidate == bot_core::images_t::DEPTH_MM_ZIPPED;
  });
  const auto index = static_cast<std::size_t>(type - types.begin());
  if (type == types.end() || index >= message.images.size()) return ConvertFault::kNoDepthImage;

  const bot_core::image_t& depth = message.images[index];
  Converted<DepthImage> header = imageHeader(message.utime, sequence, depth.width, depth.height, kBotCoreDepthUnit_m);
  if (std::holds_alternative<ConvertFault>(header)) return header;
  auto& image = std::get<DepthImage>(header);
  Converted<Pixels> pixels = *type == bot_core::images_t::DEPTH_MM_ZIPPED
                                 ? zippedPixels(depth.data, image, depth.row_stride)
                                 : stridedPixels(depth.data, image, depth.row_stride);
  return withPixels(std::move(image), std::move(pixels));
}

Converted<DepthImage> toDepthImage(const bot_core::image_t& message, std::uint64_t sequence) {
  const bool big_endian = message.pixelformat == bot_core::image_t::PIXEL_FORMAT_BE_GRAY16;
  if (!big_endian && message.pixelformat != bot_core::image_t::PIXEL_FORMAT_LE_GRAY16) {
    return ConvertFault::kUnknownPixelFormat;
  }
  Converted<DepthImage> header =
      imageHeader(message.utime, sequence, message.width, message.height, kBotCoreDepthUnit_m);
  if (std::holds_alternative<ConvertFault>(header)) return header;
  auto& image = std::get<DepthImage>(header);
  Converted<Pixels> pixels = stridedPixels(message.data, image, message.row_stride);
  if (auto* values = std::get_if<Pixels>(&pixels); values && big_endian) {
    for (std::uint16_t& value : *values) value = static_cast<std::uint16_t>((value << 8U) | (value >> 8U));
  }
  return withPixels(std::move(image), std::move(pixels));
}

depth_image_t toMessage(const DepthImage& image, const std::string& camera, DepthCompression compression) {
  depth_image_t message{};
  message.utime = utimeFromTime(image.stamp);
  message.sequence = static_cast<std::int64_t>(image.sequence);
  message.camera = camera;
  message.width = image.width_px;
  message.height = image.height_px;
  message.depth_unit = image.depth_unit_m;
  message.compression = static_cast<std::int8_t>(compression);
  if (compression == DepthCompression::kBlosc) {
    message.data = compressDepth(image.pixels);
  } else {
    message.data.resize(image.pixels.size() * kPixelBytes);
    if (!image.pixels.empty()) std::memcpy(message.data.data(), image.pixels.data(), message.data.size());
  }
  message.size = static_cast<std::int32_t>(message.data.size());
  return message;
}

}  // namespace nanomap
