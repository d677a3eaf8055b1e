#pragma once

#include <gtest/gtest.h>

#include "drivers/lcm/message_types.h"

namespace nanomap {

template <class First, class... Rest>
struct AllButFirst {
  using Types = ::testing::Types<Rest...>;
};

/// Every type of lcm_types, for typed tests.
#define NANOMAP_COMMA_TYPE(Message) , Message
using AllMessageTypes = AllButFirst<void NANOMAP_FOR_EACH_MESSAGE_TYPE(NANOMAP_COMMA_TYPE)>::Types;
#undef NANOMAP_COMMA_TYPE

struct MessageTypeName {
  template <class Message>
  static std::string GetName(int) {
    return Message::getTypeName();
  }
};

}  // namespace nanomap
