#include "drivers/lcm/message_layout.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/lcm/message_types.h"

namespace nanomap {
namespace {

/// Walks over the fields of a message without keeping any. After the first fault every step does nothing.
class FieldWalker {
 public:
  explicit FieldWalker(Bytes fields) : cursor_(fields) {}

  [[nodiscard]] std::optional<DecodeFault> finish() const {
    if (failed_) return fault_;
    if (cursor_.remaining() > 0) return DecodeFault::kTrailingBytes;
    return std::nullopt;
  }

  [[nodiscard]] bool failed() const { return failed_; }

  /// Fields of fixed size, in order.
  template <class... Fields>
  void fixed() {
    bytes((sizeof(Fields) + ...));
  }

  void bytes(std::size_t size) {
    if (failed()) return;
    static_cast<void>(cursor_.take(size));
    if (!cursor_.ok()) fail(DecodeFault::kTruncated);
  }

  /// A length and the NUL-terminated text that it counts, terminator included. A NUL before it would cut the text off
  /// when it is encoded again.
  void string() {
    const Bytes text = cursor_.take(count(1));
    if (failed()) return;
    if (text.empty() || std::find(text.begin(), text.end(), 0) != text.end() - 1) fail(DecodeFault::kBadLength);
  }

  /// A length and that many elements of fixed size.
  void array(std::size_t element_bytes) { bytes(count(element_bytes) * element_bytes); }

  /// A length, to be followed by that many elements of at least `min_element_bytes` each.
  [[nodiscard]] std::size_t count(std::size_t min_element_bytes) {
    if (failed()) return 0;
    const auto length = cursor_.read<std::int32_t>();
    if (!cursor_.ok()) {
      fail(DecodeFault::kTruncated);
    } else if (length < 0) {
      fail(DecodeFault::kBadLength);
    } else if (static_cast<std::size_t>(length) > cursor_.remaining() / min_element_bytes) {
      fail(DecodeFault::kTruncated);
    }
    return failed() ? 0 : static_cast<std::size_t>(length);
  }

 private:
  void fail(DecodeFault fault) {
    failed_ = true;
    fault_ = fault;
  }

  ByteCursor cursor_;
  bool failed_ = false;
  DecodeFault fault_{};  ///< valid if failed
};

using Boolean = std::int8_t;
template <std::size_t n>
using Doubles = std::array<double, n>;

/// Encoded size of nanomap.transform_t and of nanomap.stamped_transform_t.
using Transform = Doubles<7>;
constexpr std::size_t kStampedTransformBytes = sizeof(std::int64_t) + sizeof(Transform);

/// Fewest bytes that an element takes: every array and string in it empty.
constexpr std::size_t kMinStringBytes = sizeof(std::int32_t) + 1;
constexpr std::size_t kMinMetadataBytes = kMinStringBytes + sizeof(std::int32_t);
constexpr std::size_t kMinImageBytes = sizeof(std::int64_t) + 6 * sizeof(std::int32_t);
constexpr std::size_t kMinAnswerBytes =
    2 * sizeof(std::int64_t) + 2 * sizeof(Doubles<12>) + 2 * sizeof(std::int8_t) + 2 * sizeof(std::int32_t);
constexpr std::size_t kMinLatencyBytes = kMinStringBytes + sizeof(std::int64_t) + sizeof(Doubles<3>);
constexpr std::size_t kMinCounterBytes = kMinStringBytes + sizeof(std::int64_t);

/// Selects the walk of a type.
template <class Message>
struct Type {};

template <class Element>
void walkArray(FieldWalker& fields, std::size_t count) {
  for (std::size_t i = 0; i < count && !fields.failed(); ++i) walk(fields, Type<Element>{});
}

void walk(FieldWalker& fields, Type<bot_core::image_metadata_t>) {
  fields.string();
  fields.array(sizeof(std::uint8_t));
}

void walk(FieldWalker& fields, Type<bot_core::image_t>) {
  fields.fixed<std::int64_t, std::int32_t, std::int32_t, std::int32_t, std::int32_t>();
  fields.array(sizeof(std::uint8_t));
  walkArray<bot_core::image_metadata_t>(fields, fields.count(kMinMetadataBytes));
}

void walk(FieldWalker& fields, Type<bot_core::images_t>) {
  fields.fixed<std::int64_t>();
  const std::size_t count = fields.count(sizeof(std::int16_t) + kMinImageBytes);
  fields.bytes(count * sizeof(std::int16_t));
  walkArray<bot_core::image_t>(fields, count);
}

void walk(FieldWalker& fields, Type<bot_core::planar_lidar_t>) {
  fields.fixed<std::int64_t>();
  fields.array(sizeof(float));
  fields.array(sizeof(float));
  fields.fixed<float, float>();
}

void walk(FieldWalker& fields, Type<bot_core::pose_t>) { fields.fixed<std::int64_t, Doubles<16>>(); }

void walk(FieldWalker& fields, Type<bot_core::rigid_transform_t>) { fields.fixed<std::int64_t, Doubles<7>>(); }

void walk(FieldWalker& fields, Type<bot_core::utime_t>) { fields.fixed<std::int64_t>(); }

void walk(FieldWalker& fields, Type<answer_t>) {
  fields.fixed<Doubles<3>, Doubles<9>, std::int8_t, Boolean, std::int32_t, std::int64_t, std::int64_t, Doubles<3>,
               Doubles<9>>();
  fields.array(sizeof(std::array<float, 3>) + sizeof(float));
}

void walk(FieldWalker& fields, Type<answers_t>) {
  fields.fixed<std::int64_t, std::int64_t, std::int32_t, Transform, std::int32_t, std::int32_t>();
  walkArray<answer_t>(fields, fields.count(kMinAnswerBytes));
}

void walk(FieldWalker& fields, Type<body_pose_t>) {
  fields.fixed<std::int64_t, std::int64_t, std::int32_t, Transform, Doubles<9>, Boolean, std::int64_t, Doubles<9>>();
}

void walk(FieldWalker& fields, Type<camera_model_t>) {
  fields.fixed<std::int64_t>();
  fields.string();
  fields.fixed<std::int32_t, std::int32_t, Doubles<4>, Doubles<5>, Transform, Doubles<3>>();
  fields.array(sizeof(std::int32_t));
}

void walk(FieldWalker& fields, Type<counter_t>) {
  fields.string();
  fields.fixed<std::int64_t>();
}

void walk(FieldWalker& fields, Type<trajectory_t>) {
  fields.fixed<std::int64_t, Doubles<9>>();
  fields.array(sizeof(double) + sizeof(Doubles<3>));
}

void walk(FieldWalker& fields, Type<decision_t>) {
  fields.fixed<std::int64_t, std::int64_t, std::int64_t, Boolean>();
  fields.fixed<std::int64_t, std::int64_t, std::int32_t, std::int32_t>();
  fields.fixed<Boolean, std::int64_t, Boolean, std::int64_t, Boolean, std::int64_t>();
  fields.string();
  fields.fixed<Boolean, std::int32_t>();
  walk(fields, Type<trajectory_t>{});
  fields.fixed<Doubles<3>, Boolean>();
  walk(fields, Type<trajectory_t>{});
  fields.fixed<double, std::int32_t, std::int32_t, std::int32_t>();
  fields.array(sizeof(std::int32_t));
  fields.fixed<std::int32_t, std::int32_t>();
}

void walk(FieldWalker& fields, Type<depth_image_t>) {
  fields.fixed<std::int64_t, std::int64_t>();
  fields.string();
  fields.fixed<std::int32_t, std::int32_t, double, std::int8_t>();
  fields.array(sizeof(std::uint8_t));
}

void walk(FieldWalker& fields, Type<goal_t>) { fields.fixed<std::int64_t, std::int64_t, std::int32_t, Doubles<4>>(); }

void walk(FieldWalker& fields, Type<latency_t>) {
  fields.string();
  fields.fixed<std::int64_t, Doubles<3>>();
}

void walk(FieldWalker& fields, Type<health_t>) {
  fields.fixed<std::int64_t, std::int64_t>();
  fields.string();
  fields.string();
  fields.fixed<Doubles<3>>();
  walkArray<latency_t>(fields, fields.count(kMinLatencyBytes));
  walkArray<counter_t>(fields, fields.count(kMinCounterBytes));
}

void walk(FieldWalker& fields, Type<lost_t>) {
  fields.fixed<std::int64_t>();
  fields.string();
  fields.fixed<std::int64_t, std::int64_t>();
}

void walk(FieldWalker& fields, Type<pose_correction_t>) {
  fields.fixed<std::int64_t, std::int64_t, std::int32_t>();
  fields.array(kStampedTransformBytes);
}

void walk(FieldWalker& fields, Type<setpoint_t>) {
  fields.fixed<std::int64_t>();
  fields.string();
  fields.fixed<Boolean, std::int64_t, Boolean, Doubles<9>, Boolean, double>();
}

void walk(FieldWalker& fields, Type<stamped_transform_t>) { fields.fixed<std::int64_t, Transform>(); }

void walk(FieldWalker& fields, Type<step_t>) {
  fields.fixed<std::int64_t, std::int64_t, std::int8_t, std::int64_t, std::int64_t>();
}

void walk(FieldWalker& fields, Type<text_t>) {
  fields.fixed<std::int64_t>();
  fields.string();
}

void walk(FieldWalker& fields, Type<transform_t>) { fields.fixed<Transform>(); }

}  // namespace

template <class Message>
std::optional<DecodeFault> checkLayout(Bytes fields) {
  FieldWalker walker(fields);
  walk(walker, Type<Message>{});
  return walker.finish();
}

#define NANOMAP_INSTANTIATE(Message) template std::optional<DecodeFault> checkLayout<Message>(Bytes);
NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_INSTANTIATE)
#undef NANOMAP_INSTANTIATE

}  // namespace nanomap
