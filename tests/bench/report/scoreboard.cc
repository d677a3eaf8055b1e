#include "tests/bench/report/scoreboard.h"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace nanomap::bench {
namespace {

/// What the kernel calls the processor.
std::string processorName() {
  std::ifstream cpuinfo("/proc/cpuinfo");
  for (std::string line; std::getline(cpuinfo, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

std::string timeText(double time_s) {
  if (time_s >= 1e-3) return fmt::format("{:.3g} ms", 1e3 * time_s);
  if (time_s >= 1e-6) return fmt::format("{:.3g} us", 1e6 * time_s);
  return fmt::format("{:.3g} ns", 1e9 * time_s);
}

}  // namespace

void Scoreboard::rate(std::string_view row, double value, const std::string& where) {
  const auto known = std::ranges::find(kRows, row, &Row::name);
  if (known == kRows.end()) throw std::logic_error(fmt::format("no row is called {}", row));
  values_[known->name].push_back({value, where});
}

void Scoreboard::record(const Contest& contest, const std::vector<Standing>& standings, const std::string& where) {
  for (const Standing& standing : standings) {
    recordTime(contest.name, standing.contestant, where, standing.median_s, standing.cold_s);
  }
  for (const Rating& rating : contest.ratings) {
    rate(rating.row, ratio(standings, rating.opponent), where + " " + contest.name);
  }
}

void Scoreboard::recordTime(const std::string& work, const std::string& contestant, const std::string& where,
                            double median_s, std::optional<double> cold_s) {
  times_.push_back({work, contestant, where, median_s, cold_s});
}

std::optional<Scoreboard::Value> Scoreboard::worst(const Row& row) const {
  const auto found = values_.find(row.name);
  if (found == values_.end()) return std::nullopt;
  const auto [least, most] = std::ranges::minmax_element(found->second, {}, &Value::value);
  return row.sense == Sense::kAtLeast ? *least : *most;
}

bool Scoreboard::reaches(const Row& row, const std::optional<Value>& value) {
  return value && (row.sense == Sense::kAtLeast ? value->value >= row.bar : value->value <= row.bar);
}

bool Scoreboard::allReached(bool every_row) const {
  return std::ranges::all_of(kRows, [&](const Row& row) {
    const auto value = worst(row);
    return (!value && !every_row) || reaches(row, value);
  });
}

void Scoreboard::print(bool every_row) const {
  for (const Row& row : kRows) {
    const auto value = worst(row);
    if (!value && !every_row) continue;
    fmt::print("{} {} {:g} {}\n", row.name, value ? fmt::format("{:.4g}", value->value) : "-", row.bar,
               reaches(row, value) ? "ok" : "short");
  }
  for (const Row& row : kRows) {
    if (const auto value = worst(row)) fmt::print("# worst of {}: {}\n", row.name, value->where);
  }
  for (const Time& time : times_) {
    const std::string cold = time.cold_s ? fmt::format("   cold {:>9}", timeText(*time.cold_s)) : "";
    fmt::print("# {:<24} {:<24} {:<16} {:>9}{}\n", time.work, time.contestant, time.where, timeText(time.median_s),
               cold);
  }
  for (const std::string& remark : remarks_) fmt::print("# {}\n", remark);
}

void Scoreboard::writeJson(const std::filesystem::path& file) const {
  nlohmann::ordered_json json;
  json["date"] = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
  json["processor"] = processorName();
  for (const Row& row : kRows) {
    nlohmann::ordered_json entry{{"name", row.name}, {"bar", row.bar}, {"at_most", row.sense == Sense::kAtMost}};
    const auto value = worst(row);
    entry["reached"] = reaches(row, value);
    if (value) {
      entry["value"] = value->value;
      for (const Value& one : values_.at(row.name))
        entry["all"].push_back({{"where", one.where}, {"value", one.value}});
    }
    json["rows"].push_back(std::move(entry));
  }
  for (const Time& time : times_) {
    nlohmann::ordered_json entry{
        {"work", time.work}, {"contestant", time.contestant}, {"where", time.where}, {"median_s", time.median_s}};
    if (time.cold_s) entry["cold_s"] = *time.cold_s;
    json["times"].push_back(std::move(entry));
  }
  json["remarks"] = remarks_;
  std::ofstream out(file);
  out << json.dump(1) << '\n';
  out.close();
  if (!out) throw std::runtime_error(file.string() + ": cannot be written");
}

}  // namespace nanomap::bench
