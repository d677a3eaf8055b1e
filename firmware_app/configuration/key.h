#pragma once

#include <algorithm>
#include <functional>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/time.h"
#include "firmware_app/configuration/configuration.h"
#include "firmware_app/configuration/rule.h"

namespace nanomap {

/// May a key be left out of the file?
enum class Presence : std::uint8_t {
  kDefaulted,    ///< yes: the initialiser in Configuration stands
  kRequired,     ///< no, once its section is there
  kAlternative,  ///< another way to say what the key before it says; never both
};

/// One key: the single definition that parsing, range checks, the annotated default file and suggestions come from.
struct Key {
  std::string name;  ///< within its section; ends in the unit
  std::string help;  ///< sentences for a user of the file
  Rule rule;
  std::function<Value(const Configuration&)> read;
  std::function<void(Configuration&, const Value&)> write;  ///< a value that the rule accepted
  Presence presence = Presence::kDefaulted;
};

/// A table of the file.
struct Section {
  std::string name;
  std::string help;
  std::vector<Key> keys;
  /// A section that may be missing as a whole: is it there, and how it starts when its first key is met.
  struct Optional {
    std::function<bool(const Configuration&)> present;
    std::function<void(Configuration&)> create;
    std::function<void(Configuration&)> fill_example;  ///< creates it with values that a reader of the file can follow
  };
  std::optional<Optional> optional;
};

// Builders. `field` is a generic lambda that returns a reference to the member, for const and mutable configurations:
// [](auto& c) -> auto& { return c.chain.history_views; }

template <class Field>
[[nodiscard]] Key booleanKey(std::string name, std::string help, Field field) {
  return {std::move(name), std::move(help), BooleanRule{}, [field](const Configuration& c) { return Value(field(c)); },
          [field](Configuration& c, const Value& v) { field(c) = std::get<bool>(v); }};
}

template <class Field>
[[nodiscard]] Key integerKey(std::string name, std::string help, IntegerRule rule, Field field) {
  return {std::move(name), std::move(help), rule,
          [field](const Configuration& c) { return Value(static_cast<std::int64_t>(field(c))); },
          [field](Configuration& c, const Value& v) {
            using Target = std::remove_reference_t<decltype(field(c))>;
            field(c) = static_cast<Target>(std::get<std::int64_t>(v));
          }};
}

template <class Field>
[[nodiscard]] Key numberKey(std::string name, std::string help, NumberRule rule, Field field) {
  return {std::move(name), std::move(help), rule, [field](const Configuration& c) { return Value(field(c)); },
          [field](Configuration& c, const Value& v) { field(c) = std::get<double>(v); }};
}

/// For a Duration; the file has it in seconds.
template <class Field>
[[nodiscard]] Key durationKey(std::string name, std::string help, NumberRule rule_s, Field field) {
  return {std::move(name), std::move(help), rule_s,
          [field](const Configuration& c) { return Value(toSeconds(field(c))); },
          [field](Configuration& c, const Value& v) { field(c) = fromSeconds(std::get<double>(v)); }};
}

template <class Field>
[[nodiscard]] Key textKey(std::string name, std::string help, TextRule rule, Field field) {
  return {std::move(name), std::move(help), rule,
          [field](const Configuration& c) { return Value(std::string(field(c))); },
          [field](Configuration& c, const Value& v) { field(c) = std::get<std::string>(v); }};
}

/// For an enumeration, each value with its word.
template <class Enum, class Field>
[[nodiscard]] Key choiceKey(std::string name, std::string help, std::vector<std::pair<std::string, Enum>> words,
                            Field field) {
  ChoiceRule rule;
  for (const auto& [word, value] : words) rule.words.push_back(word);
  return {std::move(name), std::move(help), std::move(rule),
          [field, words](const Configuration& c) {
            const Enum value = field(c);
            return Value(
                std::find_if(words.begin(), words.end(), [value](const auto& w) { return w.second == value; })->first);
          },
          [field, words](Configuration& c, const Value& v) {
            const auto& text = std::get<std::string>(v);
            field(c) =
                std::find_if(words.begin(), words.end(), [&text](const auto& w) { return w.first == text; })->second;
          }};
}

}  // namespace nanomap
