#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "nanomap/decision_t.hpp"

namespace nanomap {

/// One field of decision_t in which decisions of two logs differ.
struct FieldDifference {
  std::string field;
  bool consumed = false;  ///< an input's number; else what was made of the inputs
  std::size_t count = 0;  ///< decisions that differ in it
  std::int64_t first_utime = 0;
  std::string first_a{};  ///< values of the first of them
  std::string first_b{};
};

/// Two logs of decisions, matched by the time planned for.
struct DecisionDiff {
  std::size_t in_a = 0;
  std::size_t in_b = 0;
  std::size_t only_in_a = 0;
  std::size_t only_in_b = 0;
  std::size_t different = 0;            ///< of those in both
  std::int64_t start_utime = 0;         ///< earliest time planned for in either
  std::int64_t first_utime = 0;         ///< of the first that differs or is in one only; valid if not same()
  std::vector<FieldDifference> fields;  ///< in the order of decision_t

  [[nodiscard]] bool same() const { return only_in_a + only_in_b + different == 0; }
};

/// Every field is compared, to the last bit of a number, NaN equal to NaN; but `sequence`, which only counts.
/// @pre each log is in the order of its times, of which none need be unique
[[nodiscard]] DecisionDiff compareDecisions(std::span<const decision_t> a, std::span<const decision_t> b);

/// As text for a terminal: where the decisions part, how often, and in what.
[[nodiscard]] std::string toText(const DecisionDiff& diff);

}  // namespace nanomap
