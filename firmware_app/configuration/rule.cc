#include "firmware_app/configuration/rule.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace nanomap {
namespace {

template <class... Functions>
struct Overloaded : Functions... {
  using Functions::operator()...;
};
template <class... Functions>
Overloaded(Functions...) -> Overloaded<Functions...>;

std::string range(const IntegerRule& rule) { return fmt::format("{} .. {}", rule.min, rule.max); }

std::string range(const NumberRule& rule) {
  return rule.above_min ? fmt::format("above {}, up to {}", rule.min, rule.max)
                        : fmt::format("{} .. {}", rule.min, rule.max);
}

bool inRange(const IntegerRule& rule, std::int64_t value) { return value >= rule.min && value <= rule.max; }

bool inRange(const NumberRule& rule, double value) {
  return std::isfinite(value) && (rule.above_min ? value > rule.min : value >= rule.min) && value <= rule.max;
}

std::optional<double> asNumber(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return *number;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  return std::nullopt;
}

std::optional<std::vector<double>> asNumbers(const Value& value) {
  if (const auto* numbers = std::get_if<std::vector<double>>(&value)) return *numbers;
  if (const auto* integers = std::get_if<std::vector<std::int64_t>>(&value)) {
    return std::vector<double>(integers->begin(), integers->end());
  }
  return std::nullopt;
}

std::string numberText(double number) {
  std::string text = fmt::format("{}", number + 0.0);  // -0.0 becomes 0.0
  return text.find_first_of(".en") == std::string::npos ? text + ".0" : text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') out += '\\';
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

}  // namespace

std::string describe(const Rule& rule) {
  return std::visit(
      Overloaded{
          [](const BooleanRule&) { return std::string("true or false"); },
          [](const IntegerRule& r) { return "an integer, " + range(r); },
          [](const NumberRule& r) { return "a number, " + range(r); },
          [](const TextRule& r) { return fmt::format("a text of 1 .. {} characters", r.max_length); },
          [](const ChoiceRule& r) { return fmt::format("\"{}\"", fmt::join(r.words, "\" or \"")); },
          [](const IntegersRule& r) { return fmt::format("at most {} integers, each {}", r.max_count, range(r.each)); },
          [](const NumbersRule& r) { return fmt::format("{} numbers, each {}", r.count, range(r.each)); },
      },
      rule);
}

std::optional<Value> accept(const Rule& rule, const Value& value) {
  const auto when = [](bool accepted, Value result) -> std::optional<Value> {
    if (!accepted) return std::nullopt;
    return result;
  };
  return std::visit(
      Overloaded{
          [&](const BooleanRule&) { return when(std::holds_alternative<bool>(value), value); },
          [&](const IntegerRule& r) {
            const auto* integer = std::get_if<std::int64_t>(&value);
            return when(integer != nullptr && inRange(r, *integer), value);
          },
          [&](const NumberRule& r) {
            const auto number = asNumber(value);
            return when(number && inRange(r, *number), number.value_or(0.0));
          },
          [&](const TextRule& r) {
            const auto* text = std::get_if<std::string>(&value);
            return when(text != nullptr && !text->empty() && text->size() <= r.max_length, value);
          },
          [&](const ChoiceRule& r) {
            const auto* text = std::get_if<std::string>(&value);
            return when(text != nullptr && std::find(r.words.begin(), r.words.end(), *text) != r.words.end(), value);
          },
          [&](const IntegersRule& r) {
            const auto* list = std::get_if<std::vector<std::int64_t>>(&value);
            return when(list != nullptr && list->size() <= r.max_count &&
                            std::all_of(list->begin(), list->end(), [&](std::int64_t i) { return inRange(r.each, i); }),
                        value);
          },
          [&](const NumbersRule& r) {
            const auto list = asNumbers(value);
            const bool accepted = list && list->size() == r.count &&
                                  std::all_of(list->begin(), list->end(), [&](double x) { return inRange(r.each, x); });
            return when(accepted, list.value_or(std::vector<double>{}));
          },
      },
      rule);
}

std::string toToml(const Value& value) {
  return std::visit(
      Overloaded{
          [](bool flag) { return std::string(flag ? "true" : "false"); },
          [](std::int64_t integer) { return std::to_string(integer); },
          [](double number) { return numberText(number); },
          [](const std::string& text) { return quoted(text); },
          [](const std::vector<std::int64_t>& list) { return fmt::format("[{}]", fmt::join(list, ", ")); },
          [](const std::vector<double>& list) {
            std::vector<std::string> texts;
            for (const double number : list) texts.push_back(numberText(number));
            return fmt::format("[{}]", fmt::join(texts, ", "));
          },
      },
      value);
}

}  // namespace nanomap
