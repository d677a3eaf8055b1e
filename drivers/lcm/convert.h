#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "bot_core/image_t.hpp"
#include "bot_core/images_t.hpp"
#include "bot_core/pose_t.hpp"
#include "core/camera_model.h"
#include "core/correction.h"
#include "core/decision.h"
#include "core/depth_image.h"
#include "core/geometry.h"
#include "core/goal.h"
#include "core/pose_buffer.h"
#include "core/time.h"
#include "core/trajectory.h"
#include "drivers/lcm/body_convention.h"
#include "nanomap/body_pose_t.hpp"
#include "nanomap/camera_model_t.hpp"
#include "nanomap/decision_t.hpp"
#include "nanomap/depth_image_t.hpp"
#include "nanomap/goal_t.hpp"
#include "nanomap/pose_correction_t.hpp"
#include "nanomap/trajectory_t.hpp"
#include "nanomap/transform_t.hpp"

/// Between LCM messages and the values of core: the one place where stamps, units and body conventions change.
/// What a value type can hold passes through, NaN included, for core to judge; what it cannot hold is a fault.
/// Arrays count by their own length, which decode() has made equal to the message's length fields.
/// Threads: functions of their arguments.
namespace nanomap {

/// Why a well-formed message says nothing that core could use.
enum class ConvertFault : std::uint8_t {
  kBadStamp,            ///< negative, or beyond 2^62 ns
  kBadSequence,         ///< negative
  kBadEpoch,            ///< negative
  kBadSize,             ///< negative, or more pixels than kMaxImagePixels
  kSizeMismatch,        ///< the data are not those of an image of that size
  kUnknownCompression,  ///< none of the constants of depth_image_t
  kUnknownPixelFormat,  ///< not 16-bit grey
  kBadCompressedData,   ///< what was compressed cannot be recovered
  kNoDepthImage,        ///< none of the images is DEPTH_MM or DEPTH_MM_ZIPPED
  kBadNoReturnValue,    ///< not a 16-bit value
};
inline constexpr std::size_t kConvertFaultCount = 10;

[[nodiscard]] std::string_view toString(ConvertFault fault);

template <class Value>
using Converted = std::variant<Value, ConvertFault>;

/// How depth_image_t carries its pixels; the values are the type's constants.
enum class DepthCompression : std::int8_t {
  kRaw = depth_image_t::RAW,
  kBlosc = depth_image_t::BLOSC,
};

/// Motion that rides along in body_pose_t.
struct BodyMotion {
  Vec3 velocity_W_m_s = Vec3::Zero();
  Vec3 angular_rate_B_rad_s = Vec3::Zero();
  Vec3 acceleration_W_m_s2 = Vec3::Zero();  ///< gravity removed
};

[[nodiscard]] Converted<Time> timeFromUtime(std::int64_t utime_us);

/// Cut to whole microseconds. @pre time is not negative
[[nodiscard]] std::int64_t utimeFromTime(Time time);

/// As sent: not normalised.
[[nodiscard]] Pose toPose(const transform_t& message);

/// The pose. An increment covariance whose interval cannot be told is left out; core counts what it misses.
[[nodiscard]] Converted<BodyPose> toBodyPose(const body_pose_t& message);

/// The pose, as FLU; its epoch is 0. @param sequence  the receiver's own count: the message has none
[[nodiscard]] Converted<BodyPose> toBodyPose(const bot_core::pose_t& message, BodyConvention convention,
                                             std::uint64_t sequence);

/// Empty if the estimator gives no velocity (NaN in all three). One that gives no acceleration (likewise) is taken to
/// move without: a plan then starts from no more than the velocity. Anything else passes through.
[[nodiscard]] std::optional<BodyMotion> toBodyMotion(const body_pose_t& message);

[[nodiscard]] Converted<Correction> toCorrection(const pose_correction_t& message);

/// The parameters as sent; CameraModel's constructor judges them.
[[nodiscard]] Converted<CameraParameters> toCameraParameters(const camera_model_t& message);

[[nodiscard]] Converted<DepthImage> toDepthImage(const depth_image_t& message);

/// The first DEPTH_MM or DEPTH_MM_ZIPPED image, at the message's own stamp. Its bytes are little-endian whatever
/// `pixelformat` says: public publishers label them BE_GRAY16 or INVALID and send their host's order.
/// @param sequence  the receiver's own count: the message has none
[[nodiscard]] Converted<DepthImage> toDepthImage(const bot_core::images_t& message, std::uint64_t sequence);

/// A lone LE_GRAY16 or BE_GRAY16 image, taken as depth at 1 mm a count.
[[nodiscard]] Converted<DepthImage> toDepthImage(const bot_core::image_t& message, std::uint64_t sequence);

[[nodiscard]] Converted<Goal> toGoal(const goal_t& message);

[[nodiscard]] transform_t toMessage(const Pose& T_A_B);

/// @param motion  NaN in the message if it is not known
[[nodiscard]] body_pose_t toMessage(const BodyPose& pose, const std::optional<BodyMotion>& motion);

/// @param computed  when the estimator computed the correction
[[nodiscard]] pose_correction_t toMessage(const Correction& correction, Time computed);

/// @param stamp  from when on the camera is known to be so
[[nodiscard]] camera_model_t toMessage(const CameraParameters& parameters, const std::string& name, Time stamp);

[[nodiscard]] depth_image_t toMessage(const DepthImage& image, const std::string& camera, DepthCompression compression);

[[nodiscard]] trajectory_t toMessage(const Trajectory& trajectory);

/// A decision's place among others.
struct DecisionPlace {
  std::uint64_t sequence = 0;  ///< the planner's own count of its decisions
  std::uint64_t step = 0;      ///< number of the last step_t before it; 0: steps are not counted
  bool flown = true;           ///< false: the vehicle was in other hands, the plan started from what was measured
};

[[nodiscard]] decision_t toMessage(const Decision& decision, const DecisionPlace& place);

/// As pod-style robots publish poses. Epoch, sequence number and increment have no place in it, and its motion is NaN:
/// publishers disagree on the frame of those fields.
[[nodiscard]] bot_core::pose_t toPoseMessage(const BodyPose& pose, BodyConvention convention);

}  // namespace nanomap
