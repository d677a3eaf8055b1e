// Prints the layout of every structure of drivers/mavlink/cmavsdk.h: "structure size offset...", one a line.
#include <cstddef>
#include <cstdio>

#include "drivers/mavlink/cmavsdk.h"

namespace {

// NOLINTNEXTLINE(cppcoreguidelines-macro-usage): offsetof needs the member's name
#define NANOMAP_PRINT_MESSAGE(Type)                                                                      \
  std::printf(#Type " %zu %zu %zu %zu %zu %zu %zu\n", sizeof(Type), offsetof(Type, message_name),        \
              offsetof(Type, system_id), offsetof(Type, component_id), offsetof(Type, target_system_id), \
              offsetof(Type, target_component_id), offsetof(Type, fields_json))

}  // namespace

int main() {
  NANOMAP_PRINT_MESSAGE(mavsdk_message_t);
  NANOMAP_PRINT_MESSAGE(mavsdk_mavlink_direct_mavlink_message_t);
}
