#pragma once

#include <stdexcept>

namespace nanomap {

/// A log that cannot be opened, read or written; the message names the file and what to do.
class LogError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace nanomap
