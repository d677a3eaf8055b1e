#pragma once

#include <cstdint>

/// What this project uses of MAVSDK's C interface (libcmavsdk 4.1.0). The wheel ships no header: these declarations are
/// ours, and a test compares every one of them with the wheel's own ctypes signatures and structures.
/// Structures handed to a callback of a plugin are the callback's to destroy; those of an interception are not.
extern "C" {

struct mavsdk_s;
struct mavsdk_configuration_s;
struct mavsdk_system_s;
struct mavsdk_mavlink_direct_s;
using mavsdk_t = mavsdk_s*;
using mavsdk_configuration_t = mavsdk_configuration_s*;
using mavsdk_system_t = mavsdk_system_s*;
using mavsdk_mavlink_direct_t = mavsdk_mavlink_direct_s*;
using mavsdk_handle_t = void*;  ///< of a subscription

/// A message with its fields as JSON; NaN is null.
struct mavsdk_mavlink_direct_mavlink_message_t {
  const char* message_name;
  std::uint32_t system_id;
  std::uint32_t component_id;
  std::uint32_t target_system_id;
  std::uint32_t target_component_id;
  const char* fields_json;
};

/// The same, as interceptions see it.
struct mavsdk_message_t {
  const char* message_name;
  std::uint32_t system_id;
  std::uint32_t component_id;
  std::uint32_t target_system_id;
  std::uint32_t target_component_id;
  const char* fields_json;
};

enum { MAVSDK_COMPONENT_TYPE_COMPANION_COMPUTER = 2 };
enum { MAVSDK_CONNECTION_RESULT_SUCCESS = 0 };
enum { MAVSDK_MAVLINK_DIRECT_RESULT_SUCCESS = 1 };

using mavsdk_log_callback_t = bool (*)(int level, const char* message, const char* file, int line, void* user_data);
/// Called on MAVSDK's sending thread. Returns 0 to drop the message.
using mavsdk_intercept_json_callback_t = int (*)(mavsdk_message_t message, void* user_data);
using mavsdk_mavlink_direct_message_callback_t = void (*)(mavsdk_mavlink_direct_mavlink_message_t message,
                                                          void* user_data);

mavsdk_configuration_t mavsdk_configuration_create_with_component_type(int component_type);
void mavsdk_configuration_set_system_id(mavsdk_configuration_t configuration, std::uint32_t system_id);
void mavsdk_configuration_set_component_id(mavsdk_configuration_t configuration, std::uint8_t component_id);
void mavsdk_configuration_destroy(mavsdk_configuration_t configuration);

mavsdk_t mavsdk_create(mavsdk_configuration_t configuration);
void mavsdk_destroy(mavsdk_t mavsdk);
int mavsdk_add_any_connection(mavsdk_t mavsdk, const char* url);
/// Those discovered so far; null if there is none. Both are the caller's: the array, and every system in it.
mavsdk_system_t* mavsdk_get_systems(mavsdk_t mavsdk, std::size_t* count);
void mavsdk_free_systems_array(mavsdk_system_t* systems);
mavsdk_handle_t mavsdk_subscribe_outgoing_messages_json(mavsdk_t mavsdk, mavsdk_intercept_json_callback_t callback,
                                                        void* user_data);
void mavsdk_unsubscribe_outgoing_messages_json(mavsdk_t mavsdk, mavsdk_handle_t handle);
/// One for the process. Returning true keeps the line from MAVSDK's own output.
void mavsdk_log_subscribe(mavsdk_log_callback_t callback, void* user_data);
void mavsdk_log_unsubscribe();

std::uint32_t mavsdk_system_get_system_id(mavsdk_system_t system);
bool mavsdk_system_has_autopilot(mavsdk_system_t system);
/// It was heard of late.
bool mavsdk_system_is_connected(mavsdk_system_t system);
void mavsdk_system_enable_timesync(mavsdk_system_t system);
void mavsdk_system_destroy(mavsdk_system_t system);

mavsdk_mavlink_direct_t mavsdk_mavlink_direct_create(mavsdk_system_t system);
void mavsdk_mavlink_direct_destroy(mavsdk_mavlink_direct_t direct);
int mavsdk_mavlink_direct_send_message(mavsdk_mavlink_direct_t direct, mavsdk_mavlink_direct_mavlink_message_t message);
mavsdk_handle_t mavsdk_mavlink_direct_subscribe_message(mavsdk_mavlink_direct_t direct, const char* message_name,
                                                        mavsdk_mavlink_direct_message_callback_t callback,
                                                        void* user_data);
void mavsdk_mavlink_direct_unsubscribe_message(mavsdk_mavlink_direct_t direct, mavsdk_handle_t handle);
void mavsdk_mavlink_direct_mavlink_message_destroy(mavsdk_mavlink_direct_mavlink_message_t* message);
}
