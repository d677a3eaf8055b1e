#include "drivers/mavlink/message_json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

namespace nanomap {
namespace {

using nlohmann::json;

constexpr std::uint8_t kMavTypeOnboardController = 18;
constexpr std::uint8_t kMavAutopilotInvalid = 8;
constexpr std::uint8_t kMavlinkVersion = 3;
constexpr std::uint8_t kFrameLocalNed = 1;
constexpr std::uint8_t kFrameBodyFrd = 12;
constexpr std::uint8_t kFrameLocalFrd = 20;
constexpr std::uint8_t kDistanceSensorUnknown = 4;  // MAV_DISTANCE_SENSOR has no word for a stereo camera
constexpr std::uint8_t kEstimatorVio = 3;
constexpr std::uint16_t kCommandSetMessageInterval = 511;

/// Reads fields of an object, and remembers if one was not as it has to be.
class FieldReader {
 public:
  explicit FieldReader(std::string_view fields) {
    // The largest message has 255 bytes of payload; as text it is never as long as this.
    constexpr std::size_t kMaxLength = 8192;
    if (fields.size() <= kMaxLength) object_ = json::parse(fields, nullptr, /*allow_exceptions=*/false);
    ok_ = object_.is_object();
  }

  [[nodiscard]] bool ok() const { return ok_; }

  [[nodiscard]] double number(const char* name) {
    const json* field = find(name);
    if (!field || !field->is_number()) return fail();
    const auto value = field->get<double>();
    return std::isfinite(value) ? value : fail();
  }

  template <class Unsigned>
  [[nodiscard]] Unsigned integer(const char* name) {
    const json* field = find(name);
    if (!field || !field->is_number_unsigned() || field->get<std::uint64_t>() > std::numeric_limits<Unsigned>::max()) {
      fail();
      return 0;
    }
    return field->get<Unsigned>();
  }

  [[nodiscard]] std::string text(const char* name) {
    const json* field = find(name);
    if (field && field->is_string()) return field->get<std::string>();
    ok_ = false;
    return {};
  }

  [[nodiscard]] Vec3 vector(const char* x, const char* y, const char* z) { return {number(x), number(y), number(z)}; }

  template <class Message>
  [[nodiscard]] std::optional<Message> finish(const Message& message) const {
    return ok_ ? std::optional(message) : std::nullopt;
  }

 private:
  [[nodiscard]] const json* find(const char* name) const {
    if (!ok_) return nullptr;
    const auto field = object_.find(name);
    return field == object_.end() ? nullptr : &*field;
  }

  double fail() {
    ok_ = false;
    return 0.0;
  }

  json object_;
  bool ok_ = false;
};

}  // namespace

std::string toJson(SystemStatus status) {
  return json{
      {"type", kMavTypeOnboardController}, {"autopilot", kMavAutopilotInvalid}, {"base_mode", 0}, {"custom_mode", 0},
      {"system_status", status},           {"mavlink_version", kMavlinkVersion}}
      .dump();
}

std::string toJson(const LocalNedTarget& target, const MavlinkAddress& to) {
  return json{{"time_boot_ms", target.time_boot_ms},
              {"target_system", to.system_id},
              {"target_component", to.component_id},
              {"coordinate_frame", kFrameLocalNed},
              {"type_mask", target.type_mask},
              {"x", target.position_NED_m.x()},
              {"y", target.position_NED_m.y()},
              {"z", target.position_NED_m.z()},
              {"vx", target.velocity_NED_m_s.x()},
              {"vy", target.velocity_NED_m_s.y()},
              {"vz", target.velocity_NED_m_s.z()},
              {"afx", target.acceleration_NED_m_s2.x()},
              {"afy", target.acceleration_NED_m_s2.y()},
              {"afz", target.acceleration_NED_m_s2.z()},
              {"yaw", target.yaw_NED_rad},
              {"yaw_rate", 0}}
      .dump();
}

std::string toJson(const ObstacleDistances& distances) {
  return json{{"time_usec", std::chrono::floor<std::chrono::microseconds>(distances.stamp.time_since_epoch()).count()},
              {"sensor_type", kDistanceSensorUnknown},
              {"distances", distances.cells_cm},
              {"increment", static_cast<int>(ObstacleDistances::kCellWidth_deg)},
              {"increment_f", ObstacleDistances::kCellWidth_deg},
              {"angle_offset", 0},
              {"min_distance", distances.min_distance_cm},
              {"max_distance", distances.max_distance_cm},
              {"frame", kFrameBodyFrd}}
      .dump();
}

std::string toJson(const OdometryMessage& odometry, Duration since_boot) {
  const Eigen::Quaternionf& q = odometry.rotation;
  return json{{"time_usec", std::chrono::floor<std::chrono::microseconds>(since_boot).count()},
              {"frame_id", kFrameLocalFrd},
              {"child_frame_id", kFrameBodyFrd},
              {"x", odometry.position_m.x()},
              {"y", odometry.position_m.y()},
              {"z", odometry.position_m.z()},
              {"q", {q.w(), q.x(), q.y(), q.z()}},
              {"vx", odometry.velocity_m_s.x()},
              {"vy", odometry.velocity_m_s.y()},
              {"vz", odometry.velocity_m_s.z()},
              {"rollspeed", odometry.angular_rate_rad_s.x()},
              {"pitchspeed", odometry.angular_rate_rad_s.y()},
              {"yawspeed", odometry.angular_rate_rad_s.z()},
              {"pose_covariance", odometry.pose_covariance},
              {"velocity_covariance", odometry.velocity_covariance},
              {"reset_counter", odometry.reset_counter},
              {"estimator_type", kEstimatorVio},
              {"quality", odometry.quality}}
      .dump();
}

std::string toJson(const StatusTextChunk& chunk) {
  return json{{"severity", chunk.severity}, {"text", chunk.text}, {"id", chunk.id}, {"chunk_seq", chunk.chunk_seq}}
      .dump();
}

std::string toJson(const MessageIntervalRequest& request, const MavlinkAddress& to) {
  const auto interval_us = std::chrono::duration_cast<std::chrono::microseconds>(request.interval).count();
  return json{{"target_system", to.system_id},
              {"target_component", to.component_id},
              {"command", kCommandSetMessageInterval},
              {"confirmation", 0},
              {"param1", request.message_id},
              {"param2", interval_us},
              {"param3", 0},
              {"param4", 0},
              {"param5", 0},
              {"param6", 0},
              {"param7", 0}}
      .dump();
}

std::string toJson(const ParameterRequest& request, const MavlinkAddress& to) {
  constexpr int kByName = -1;
  return json{{"target_system", to.system_id},
              {"target_component", to.component_id},
              {"param_id", request.name},
              {"param_index", kByName}}
      .dump();
}

template <>
std::optional<HeartbeatMessage> fromJson(std::string_view fields) {
  FieldReader reader(fields);
  HeartbeatMessage message;
  message.autopilot = reader.integer<std::uint8_t>("autopilot");
  message.base_mode = reader.integer<std::uint8_t>("base_mode");
  message.custom_mode = reader.integer<std::uint32_t>("custom_mode");
  message.type = reader.integer<std::uint8_t>("type");
  return reader.finish(message);
}

template <>
std::optional<LocalPositionMessage> fromJson(std::string_view fields) {
  FieldReader reader(fields);
  LocalPositionMessage message;
  message.time_boot_ms = reader.integer<std::uint32_t>("time_boot_ms");
  message.position_NED_m = reader.vector("x", "y", "z");
  message.velocity_NED_m_s = reader.vector("vx", "vy", "vz");
  return reader.finish(message);
}

template <>
std::optional<AttitudeMessage> fromJson(std::string_view fields) {
  FieldReader reader(fields);
  AttitudeMessage message;
  message.time_boot_ms = reader.integer<std::uint32_t>("time_boot_ms");
  const double w = reader.number("q1");
  message.R_NED_FRD.vec() = reader.vector("q2", "q3", "q4");
  message.R_NED_FRD.w() = w;
  if (!(std::abs(message.R_NED_FRD.norm() - 1.0) <= kUnitNormTolerance)) return std::nullopt;
  message.R_NED_FRD.normalize();
  message.angular_rate_FRD_rad_s = reader.vector("rollspeed", "pitchspeed", "yawspeed");
  return reader.finish(message);
}

template <>
std::optional<LandedStateMessage> fromJson(std::string_view fields) {
  FieldReader reader(fields);
  LandedStateMessage message;
  message.landed_state = reader.integer<std::uint8_t>("landed_state");
  return reader.finish(message);
}

template <>
std::optional<ParameterMessage> fromJson(std::string_view fields) {
  FieldReader reader(fields);
  ParameterMessage message;
  message.name = reader.text("param_id");
  message.value = static_cast<float>(reader.number("param_value"));
  message.type = reader.integer<std::uint8_t>("param_type");
  return reader.finish(message);
}

std::optional<std::uint32_t> fieldFromJson(std::string_view fields, const char* name) {
  FieldReader reader(fields);
  const auto value = reader.integer<std::uint32_t>(name);
  return reader.finish(value);
}

}  // namespace nanomap
