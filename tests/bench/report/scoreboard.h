#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tests/bench/report/contest.h"

namespace nanomap::bench {

enum class Sense { kAtLeast, kAtMost };

/// A figure with a bar that it is to reach.
struct Row {
  std::string_view name;  ///< what is measured / what it is compared with
  double bar;
  Sense sense;
};

/// Every row, in the order of printing. Ratios are times of the reference divided by ours, unless they are at most.
inline constexpr std::array kRows = {
    Row{"build/flann15", 45.0, Sense::kAtLeast},
    Row{"build/nanoflann10", 80.0, Sense::kAtLeast},
    Row{"nearest_k1_noisy/nanoflann", 3.5, Sense::kAtLeast},
    Row{"nearest_k1_clean/nanoflann", 5.5, Sense::kAtLeast},
    Row{"nearest_k10_noisy/nanoflann", 3.0, Sense::kAtLeast},
    Row{"nearest_k10_clean/nanoflann", 4.0, Sense::kAtLeast},
    Row{"nearest_k1_within_1m/nanoflann", 2.3, Sense::kAtLeast},
    Row{"nearest_k1/flann15", 20.0, Sense::kAtLeast},
    Row{"nearest_k10/flann15", 10.0, Sense::kAtLeast},
    Row{"in_none_of_150_views/walk", 30.0, Sense::kAtLeast},
    Row{"occluded_in_150_views/walk", 20.0, Sense::kAtLeast},
    Row{"correct_150_poses/slerp", 3.0, Sense::kAtLeast},
    Row{"cycle_75_percent_current/nanoflann", 9.0, Sense::kAtLeast},
    Row{"cycle_75_percent_current/flann15", 12.0, Sense::kAtLeast},
    Row{"cycle_100_views_deep/nanoflann", 9.0, Sense::kAtLeast},
    Row{"cycle_100_views_deep/flann15", 12.0, Sense::kAtLeast},
    Row{"cycle_in_no_view/nanoflann", 9.0, Sense::kAtLeast},
    Row{"cycle_in_no_view/flann15", 12.0, Sense::kAtLeast},
    Row{"cycle_occluded/nanoflann", 9.0, Sense::kAtLeast},
    Row{"cycle_occluded/flann15", 12.0, Sense::kAtLeast},
    Row{"memory_of_150_views_mb", 64.0, Sense::kAtMost},
    Row{"query_848x480/query_320x240", 2.2, Sense::kAtMost},
    Row{"build_pixel_848x480/build_pixel_320x240", 1.2, Sense::kAtMost},
    Row{"distances_that_differ", 0.0, Sense::kAtMost},
    Row{"views_that_differ", 0.0, Sense::kAtMost},
    Row{"plan_p99_ms", 2.0, Sense::kAtMost},
    Row{"plan_early_exit_median_ms", 1.0, Sense::kAtMost},
};

/// Collects what is measured, and keeps the worst of each row. Threads: one.
class Scoreboard {
 public:
  /// One value of a row. @throws std::logic_error if there is no such row
  void rate(std::string_view row, double value, const std::string& where);

  /// A contest's outcome: its times, and the rows that it decides.
  void record(const Contest& contest, const std::vector<Standing>& standings, const std::string& where);

  /// A time that no row is made of [s]. @param cold_s  if it was measured: of what comes after other work
  void recordTime(const std::string& work, const std::string& contestant, const std::string& where, double median_s,
                  std::optional<double> cold_s = std::nullopt);

  /// Something that a reader of the figures should know.
  void remark(const std::string& text) { remarks_.push_back(text); }

  /// One line a row, `name value bar ok|short`, then times and remarks as lines that begin with #. A row without value
  /// shows `-` and is short; on recorded frames some have none, and are left out.
  void print(bool every_row) const;

  /// The same as JSON, with the machine's processor and the date.
  /// @throws std::runtime_error naming the file if it cannot be written
  void writeJson(const std::filesystem::path& file) const;

  [[nodiscard]] bool allReached(bool every_row) const;

 private:
  struct Value {
    double value = 0.0;
    std::string where;
  };
  struct Time {
    std::string work;
    std::string contestant;
    std::string where;
    double median_s = 0.0;
    std::optional<double> cold_s;
  };

  [[nodiscard]] std::optional<Value> worst(const Row& row) const;
  [[nodiscard]] static bool reaches(const Row& row, const std::optional<Value>& value);

  std::map<std::string_view, std::vector<Value>> values_;  ///< by row
  std::vector<Time> times_;
  std::vector<std::string> remarks_;
};

}  // namespace nanomap::bench
