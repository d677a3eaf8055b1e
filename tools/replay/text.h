#pragma once

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

namespace nanomap {

inline constexpr double kPercent = 100.0;

/// Percent; 0 of nothing.
[[nodiscard]] inline double share(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? 0.0 : kPercent * static_cast<double>(part) / static_cast<double>(whole);
}

/// Lines for a terminal.
class Text {
 public:
  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Args>(args)...);
    text_ += '\n';
  }

  /// One indented line for every reason that occurred.
  template <class Enum, class Counters>
  void reasons(const Counters& counters) {
    for (std::size_t i = 0; i < counters.size(); ++i) {
      if (counters[i] > 0) line("    {:>8}  {}", counters[i], toString(static_cast<Enum>(i)));
    }
  }

  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  std::string text_;
};

}  // namespace nanomap
