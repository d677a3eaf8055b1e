#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace nanomap {

/// A value of the configuration file. An integer stands for a number where a number is wanted.
using Value = std::variant<bool, std::int64_t, double, std::string, std::vector<std::int64_t>, std::vector<double>>;

/// What a key accepts: type and range. NaN and infinity are never accepted.
struct BooleanRule {};

struct IntegerRule {
  std::int64_t min = 0;
  std::int64_t max = 0;
};

struct NumberRule {
  double min = 0.0;
  double max = 0.0;
  bool above_min = false;  ///< the lower bound itself is not allowed
};

struct TextRule {
  std::size_t max_length = 0;  ///< bytes; at least one
};

struct ChoiceRule {
  std::vector<std::string> words;
};

struct IntegersRule {
  std::size_t max_count = 0;  ///< may be empty
  IntegerRule each;
};

struct NumbersRule {
  std::size_t count = 0;
  NumberRule each;
};

using Rule = std::variant<BooleanRule, IntegerRule, NumberRule, TextRule, ChoiceRule, IntegersRule, NumbersRule>;

/// What the rule accepts, in words: "an integer in 1 .. 16".
[[nodiscard]] std::string describe(const Rule& rule);

/// `value` in the rule's own type, or empty if the rule does not accept it.
[[nodiscard]] std::optional<Value> accept(const Rule& rule, const Value& value);

/// `value` as TOML. Numbers keep every bit and always look like numbers: 5.0, not 5.
[[nodiscard]] std::string toToml(const Value& value);

}  // namespace nanomap
