#include "drivers/mavlink/mavlink_link.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <map>
#include <mutex>
#include <stdexcept>
#include <utility>
#include <vector>

#include "drivers/mavlink/cmavsdk.h"
#include "drivers/mavlink/outgoing_gate.h"
#include "drivers/mavlink/parameter_value.h"

namespace nanomap {
namespace {

constexpr std::uint32_t kAutopilotComponent = 1;  // MAV_COMP_ID_AUTOPILOT1
constexpr std::uint8_t kNoSystem = 0;             // MAVLink's ids are 1 .. 255
constexpr Duration kHeartbeatPeriod = std::chrono::seconds(1);

template <auto Destroy>
struct Destroyer {
  template <class Object>
  void operator()(Object* object) const {
    Destroy(object);
  }
};
using Mavsdk = std::unique_ptr<mavsdk_s, Destroyer<mavsdk_destroy>>;
using System = std::unique_ptr<mavsdk_system_s, Destroyer<mavsdk_system_destroy>>;
using Direct = std::unique_ptr<mavsdk_mavlink_direct_s, Destroyer<mavsdk_mavlink_direct_destroy>>;

/// Has every message shown to `callback` before it leaves, for as long as this lives.
class Interception {
 public:
  Interception(mavsdk_t mavsdk, mavsdk_intercept_json_callback_t callback, void* user_data)
      : mavsdk_(mavsdk), handle_(mavsdk_subscribe_outgoing_messages_json(mavsdk, callback, user_data)) {}
  ~Interception() { mavsdk_unsubscribe_outgoing_messages_json(mavsdk_, handle_); }
  Interception(const Interception&) = delete;
  Interception& operator=(const Interception&) = delete;

 private:
  mavsdk_t mavsdk_;
  mavsdk_handle_t handle_;
};

/// All that MAVSDK has heard of so far.
std::vector<System> systemsOf(mavsdk_t mavsdk) {
  std::size_t count = 0;
  const std::unique_ptr<mavsdk_system_t, Destroyer<mavsdk_free_systems_array>> found(
      mavsdk_get_systems(mavsdk, &count));
  std::vector<System> systems;
  for (std::size_t i = 0; found && i < count; ++i) systems.emplace_back(found.get()[i]);
  return systems;
}

constexpr int kBindError = 3;  // of MAVSDK's connection results

/// What the connection result of MAVSDK says to do.
std::string_view remedyOf(int connection_result) {
  constexpr int kUrlInvalid = 12;
  constexpr int kBaudrateUnknown = 13;
  switch (connection_result) {
    case kBindError:
      return "the port is taken: stop what uses it, or choose another one";
    case kUrlInvalid:
      return "write udpin://0.0.0.0:14540, udpout://HOST:PORT, tcpout://HOST:PORT or serial:///dev/DEVICE:BAUD";
    case kBaudrateUnknown:
      return "the line does not know this baud rate";
    default:
      return "check that the address is right, that the other end is there, and that the device may be opened";
  }
}

Mavsdk createMavsdk(const LinkParameters& parameters) {
  if (parameters.system_id == 0) throw std::invalid_argument("MAVLink: system_id must lie between 1 and 255");
  if (parameters.component_id <= kAutopilotComponent) {
    throw std::invalid_argument("MAVLink: component_id must lie between 2 and 255; 1 is the autopilot's");
  }
  if (!(parameters.pose_rate_hz > 0.0)) throw std::invalid_argument("MAVLink: pose_rate_hz must be positive");
  const std::unique_ptr<mavsdk_configuration_s, Destroyer<mavsdk_configuration_destroy>> configuration(
      mavsdk_configuration_create_with_component_type(MAVSDK_COMPONENT_TYPE_COMPANION_COMPUTER));
  mavsdk_configuration_set_system_id(configuration.get(), parameters.system_id);
  mavsdk_configuration_set_component_id(configuration.get(), parameters.component_id);
  return Mavsdk(mavsdk_create(configuration.get()));
}

std::vector<MessageIntervalRequest> wantedStreams(double pose_rate_hz) {
  constexpr std::uint32_t kHeartbeat = 0;
  constexpr std::uint32_t kAttitudeQuaternion = 31;
  constexpr std::uint32_t kLocalPositionNed = 32;
  constexpr std::uint32_t kExtendedSysState = 245;
  const Duration pose_interval = fromSeconds(1.0 / pose_rate_hz);
  return {{kHeartbeat, std::chrono::milliseconds(200)},  // the pilot's mode is in it
          {kExtendedSysState, std::chrono::milliseconds(500)},
          {kLocalPositionNed, pose_interval},
          {kAttitudeQuaternion, pose_interval}};
}

}  // namespace

/// Lives at one address: MAVSDK's callbacks point to it.
class MavlinkLink::Session {
 public:
  Session(const LinkParameters& parameters, Clock now)
      : now_(std::move(now)),
        wanted_streams_(wantedStreams(parameters.pose_rate_hz)),
        monitor_(parameters.heartbeat_timeout),
        autopilot_{.system_id = parameters.system_id},
        mavsdk_(createMavsdk(parameters)),
        interception_(mavsdk_.get(), &Session::onOutgoing, this) {
    const int result = mavsdk_add_any_connection(mavsdk_.get(), parameters.url.c_str());
    if (result != MAVSDK_CONNECTION_RESULT_SUCCESS) {
      const std::string reason = "MAVLink: cannot open '" + parameters.url + "' (MAVSDK's result " +
                                 std::to_string(result) + "): " + std::string(remedyOf(result));
      if (result == kBindError) throw PortTaken(reason);
      throw std::runtime_error(reason);
    }
  }
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  ~Session() {
    for (const mavsdk_handle_t subscription : subscriptions_) {
      mavsdk_mavlink_direct_unsubscribe_message(direct_.get(), subscription);
    }
  }

  void keepAlive(SystemStatus status) {
    if (!direct_ && !discover()) return;
    const Time now = now_();
    if (status != last_status_ || now >= next_heartbeat_) {
      own_heartbeats_ = true;
      (void)sendMessage("HEARTBEAT", toJson(status));
      (void)lookAround();
      last_status_ = status;
      next_heartbeat_ = now + kHeartbeatPeriod;
    }
    requestStreams(now);
  }

  SendResult send(const LocalNedTarget& target) {
    if (!direct_) return SendResult::kNoAutopilot;
    if (!target.isFinite()) {
      ++refused_;
      return SendResult::kNotFinite;
    }
    return sendMessage("SET_POSITION_TARGET_LOCAL_NED", toJson(target, autopilot_), setpoints_sent_);
  }

  SendResult send(const OdometryMessage& odometry) {
    // In the autopilot's time: that is what MAVSDK's timesync makes it believe to be ours.
    const std::optional<Duration> since_boot = sinceBoot(odometry.stamp);
    if (!since_boot) return SendResult::kNoClock;
    return sendMessage("ODOMETRY", toJson(odometry, *since_boot));
  }

  SendResult sendText(Severity severity, std::string_view text) {
    SendResult result = SendResult::kSent;
    for (const StatusTextChunk& chunk : statusTextChunks(severity, text, ++text_id_)) {
      if (const SendResult sent = sendMessage("STATUSTEXT", toJson(chunk)); sent != SendResult::kSent) result = sent;
    }
    return result;
  }

  SendResult sendMessage(const char* name, const std::string& fields) {
    return sendMessage(name, fields, others_sent_);
  }

  AutopilotState autopilot() {
    const std::lock_guard lock(monitor_mutex_);
    return monitor_.state(now_());
  }

  std::optional<Duration> sinceBoot(Time time) {
    const std::lock_guard lock(monitor_mutex_);
    return monitor_.sinceBoot(time);
  }

  std::optional<AutopilotPose> takePose() {
    const std::lock_guard lock(monitor_mutex_);
    return monitor_.takePose();
  }

  [[nodiscard]] std::optional<std::uint8_t> otherAutopilot() const {
    const std::uint8_t system = other_autopilot_;
    return system == kNoSystem ? std::nullopt : std::optional(system);
  }

  SendResult requestParameter(const std::string& name) {
    {
      const std::lock_guard lock(monitor_mutex_);
      parameters_.try_emplace(name);
    }
    return sendMessage("PARAM_REQUEST_READ", toJson(ParameterRequest{name}, autopilot_));
  }

  std::optional<double> parameter(const std::string& name) {
    const std::lock_guard lock(monitor_mutex_);
    const auto told = parameters_.find(name);
    if (told == parameters_.end() || !told->second) return std::nullopt;
    return numberOf(*told->second, monitor_.state(now_()).kind);
  }

  LinkCounters counters() {
    LinkCounters counters;
    counters.setpoints_sent = setpoints_sent_;
    counters.others_sent = others_sent_;
    counters.refused = refused_;
    counters.stale_setpoints = stale_setpoints_;
    counters.received = received_;
    counters.malformed = malformed_;
    const std::lock_guard lock(monitor_mutex_);
    counters.autopilot = monitor_.counters();
    return counters;
  }

 private:
  using Counter = std::atomic<std::uint64_t>;

  /// The vehicle's autopilot, if it is heard. Notes whether another one is.
  System lookAround() {
    System ours;
    std::uint8_t other = kNoSystem;
    for (System& system : systemsOf(mavsdk_.get())) {
      if (!mavsdk_system_has_autopilot(system.get()) || !mavsdk_system_is_connected(system.get())) continue;
      const auto id = static_cast<std::uint8_t>(mavsdk_system_get_system_id(system.get()));
      if (id == autopilot_.system_id) {
        ours = std::move(system);
      } else {
        other = std::max(other, id);
      }
    }
    other_autopilot_ = other;
    return ours;
  }

  bool discover() {
    system_ = lookAround();
    if (!system_) return false;
    mavsdk_system_enable_timesync(system_.get());
    direct_.reset(mavsdk_mavlink_direct_create(system_.get()));
    subscribe<HeartbeatMessage>("HEARTBEAT");
    subscribe<LocalPositionMessage>("LOCAL_POSITION_NED");
    subscribe<AttitudeMessage>("ATTITUDE_QUATERNION");
    subscribe<LandedStateMessage>("EXTENDED_SYS_STATE");
    subscribe<ParameterMessage>("PARAM_VALUE");
    return true;
  }

  template <class Message>
  void subscribe(const char* name) {
    subscriptions_.push_back(
        mavsdk_mavlink_direct_subscribe_message(direct_.get(), name, &Session::onMessage<Message>, this));
  }

  void requestStreams(Time now) {
    if (now < next_request_) return;
    constexpr Duration kSilent = std::chrono::seconds(1);
    constexpr Duration kRetry = std::chrono::seconds(1);
    constexpr Duration kRefresh = std::chrono::seconds(10);  // a request can be lost, and an autopilot restart
    const AutopilotState state = autopilot();
    const bool complete = state.position_age && *state.position_age < kSilent &&  //
                          state.attitude_age && *state.attitude_age < kSilent;
    next_request_ = now + (complete ? kRefresh : kRetry);
    for (const MessageIntervalRequest& request : wanted_streams_) {
      (void)sendMessage("COMMAND_LONG", toJson(request, autopilot_));
    }
  }

  SendResult sendMessage(const char* name, const std::string& fields, Counter& sent) {
    if (!direct_) return SendResult::kNoAutopilot;
    mavsdk_mavlink_direct_mavlink_message_t message{};
    message.message_name = name;
    message.target_system_id = autopilot_.system_id;
    message.target_component_id = autopilot_.component_id;
    message.fields_json = fields.c_str();
    const int result = mavsdk_mavlink_direct_send_message(direct_.get(), message);
    if (result != MAVSDK_MAVLINK_DIRECT_RESULT_SUCCESS) {
      ++refused_;
      return SendResult::kRefused;
    }
    ++sent;
    return SendResult::kSent;
  }

  /// On MAVSDK's callback thread.
  template <class Message>
  static void onMessage(mavsdk_mavlink_direct_mavlink_message_t message, void* self) {
    static_cast<Session*>(self)->receive<Message>(message);
    mavsdk_mavlink_direct_mavlink_message_destroy(&message);
  }

  template <class Message>
  void receive(const mavsdk_mavlink_direct_mavlink_message_t& message) noexcept {
    if (message.system_id != autopilot_.system_id || message.component_id != kAutopilotComponent) return;
    ++received_;
    const Time arrival = now_();
    const auto fields = fromJson<Message>(message.fields_json);
    if (!fields) {
      ++malformed_;
      return;
    }
    const std::lock_guard lock(monitor_mutex_);
    keep(*fields, arrival);
  }

  template <class Message>
  void keep(const Message& message, Time arrival) {
    monitor_.receive(message, arrival);
  }
  void keep(const ParameterMessage& message, Time /*arrival*/) {
    const auto wanted = parameters_.find(message.name);  // an autopilot may tell all of its hundreds
    if (wanted != parameters_.end()) wanted->second = message;
  }

  /// On MAVSDK's sending thread.
  static int onOutgoing(mavsdk_message_t message, void* self) noexcept {
    auto& session = *static_cast<Session*>(self);
    const GateVerdict verdict =
        judgeOutgoing(message.message_name, message.fields_json, session.own_heartbeats_, session.now_());
    if (verdict == GateVerdict::kStaleSetpoint) ++session.stale_setpoints_;
    return verdict == GateVerdict::kPass ? 1 : 0;
  }

  Clock now_;
  std::vector<MessageIntervalRequest> wanted_streams_;

  std::mutex monitor_mutex_;
  AutopilotMonitor monitor_;
  std::map<std::string, std::optional<ParameterMessage>> parameters_;  ///< that were asked for

  std::atomic<bool> own_heartbeats_ = false;
  Counter setpoints_sent_ = 0;
  Counter others_sent_ = 0;
  Counter refused_ = 0;
  Counter stale_setpoints_ = 0;
  Counter received_ = 0;
  Counter malformed_ = 0;

  std::optional<SystemStatus> last_status_;
  Time next_heartbeat_{};
  Time next_request_{};
  std::uint16_t text_id_ = 0;
  const MavlinkAddress autopilot_;
  std::atomic<std::uint8_t> other_autopilot_ = kNoSystem;

  // Destroyed in the reverse order, as MAVSDK wants it; its threads end with the first of them.
  Mavsdk mavsdk_;
  Interception interception_;
  System system_;
  Direct direct_;
  std::vector<mavsdk_handle_t> subscriptions_;
};

MavlinkLink::MavlinkLink(const LinkParameters& parameters, Clock now)
    : session_(std::make_unique<Session>(parameters, std::move(now))) {}

MavlinkLink::~MavlinkLink() = default;

void MavlinkLink::keepAlive(SystemStatus status) { session_->keepAlive(status); }
SendResult MavlinkLink::send(const LocalNedTarget& target) { return session_->send(target); }
SendResult MavlinkLink::send(const ObstacleDistances& distances) {
  return session_->sendMessage("OBSTACLE_DISTANCE", toJson(distances));
}
SendResult MavlinkLink::send(const OdometryMessage& odometry) { return session_->send(odometry); }
SendResult MavlinkLink::sendText(Severity severity, std::string_view text) {
  return session_->sendText(severity, text);
}
AutopilotState MavlinkLink::autopilot() const { return session_->autopilot(); }
std::optional<AutopilotPose> MavlinkLink::takePose() { return session_->takePose(); }
LinkCounters MavlinkLink::counters() const { return session_->counters(); }
std::optional<std::uint8_t> MavlinkLink::otherAutopilot() const { return session_->otherAutopilot(); }
SendResult MavlinkLink::requestParameter(const std::string& name) { return session_->requestParameter(name); }
std::optional<double> MavlinkLink::parameter(const std::string& name) const { return session_->parameter(name); }

}  // namespace nanomap
