#include "tests/bench/rows/plan_times.h"

#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>
#include <utility>

#include "core/level_frame.h"
#include "tools/replay/percentile.h"

namespace nanomap::bench {
namespace {

PlannerParameters withEarlyExit(bool early_exit) {
  PlannerParameters parameters;
  parameters.early_exit = early_exit;
  return parameters;
}

}  // namespace

PlanTimes::PlanTimes(std::shared_ptr<const ChainFixture> fixture, std::size_t plans)
    : fixture_(std::move(fixture)), exhaustive_(withEarlyExit(false)), early_(withEarlyExit(true)) {
  constexpr unsigned kSeed = 11;
  constexpr double kGoalDistance_m = 30.0;
  constexpr double kTopSpeed_m_s = 8.0;
  constexpr double kMostAside_rad = 1.0;
  std::mt19937 random(kSeed);
  std::uniform_real_distribution<double> speed_m_s(0.0, kTopSpeed_m_s);
  std::uniform_real_distribution<double> course_rad(-0.3, 0.3);
  std::uniform_real_distribution<double> aside_rad(-kMostAside_rad, kMostAside_rad);
  const ChainSnapshot& snapshot = fixture_->after;
  const double yaw_W_rad = yawOf(snapshot.T_W_B.rotation);
  const auto ahead_W = [&](double angle_rad) -> Vec3 { return levelAxes(yaw_W_rad + angle_rad) * Vec3::UnitX(); };
  for (std::size_t i = 0; i < plans; ++i) {
    Task task;
    task.state.stamp = snapshot.stamp;
    task.state.epoch = snapshot.epoch;
    task.state.T_W_B = snapshot.T_W_B;
    task.state.velocity_W_m_s = speed_m_s(random) * ahead_W(course_rad(random));
    task.goal = Goal{.stamp = snapshot.stamp,
                     .sequence = i,
                     .epoch = snapshot.epoch,
                     .position_W_m = snapshot.T_W_B.translation_m + kGoalDistance_m * ahead_W(aside_rad(random)),
                     .top_speed_m_s = kTopSpeed_m_s};
    if (plan(exhaustive_, task).evaluated < kLibrarySize) throw std::logic_error("a plan leaves primitives out");
    tasks_.push_back(task);
  }
}

Decision PlanTimes::plan(const Planner& planner, const Task& task) const {
  return planner.plan(fixture_->after, task.state, task.goal, task.state.stamp);
}

Contest PlanTimes::contest() const {
  const auto contestant = [this](const char* name, const Planner& planner) {
    return Contestant{.name = name, .items = static_cast<double>(tasks_.size()), .run = [this, &planner] {
                        for (const Task& task : tasks_) benchmark::DoNotOptimize(plan(planner, task));
                      }};
  };
  return {.name = "plan",
          .contestants = {contestant("nanomap_early_exit", early_), contestant("nanomap_exhaustive", exhaustive_)},
          .ratings = {}};
}

std::vector<double> PlanTimes::times_s(const Planner& planner, int rounds) const {
  std::vector<double> times_s;
  for (const Task& task : tasks_) {
    std::vector<double> of_task_s;
    for (int round = 0; round < rounds; ++round) {
      const double start_s = threadTime_s();
      benchmark::DoNotOptimize(plan(planner, task));
      of_task_s.push_back(threadTime_s() - start_s);
    }
    times_s.push_back(percentile<double>(of_task_s, 0.5));
  }
  return times_s;
}

PlanTimes::Times PlanTimes::record(Scoreboard& scoreboard, int rounds, const std::string& where) const {
  const auto spreadOf = [&](const char* name, const Planner& planner) {
    const std::vector<double> of_plans_s = times_s(planner, rounds);
    const Spread spread{percentile<double>(of_plans_s, 0.5), percentile<double>(of_plans_s, 0.99)};
    scoreboard.recordTime("plan", name, where, spread.median_s);
    scoreboard.recordTime("plan_p99", name, where, spread.p99_s);
    return spread;
  };
  return {spreadOf("nanomap_exhaustive", exhaustive_), spreadOf("nanomap_early_exit", early_)};
}

void PlanTimes::rate(Scoreboard& scoreboard, int rounds, const std::string& where) const {
  const Times times = record(scoreboard, rounds, where);
  scoreboard.rate("plan_p99_ms", 1e3 * times.exhaustive.p99_s, where);
  scoreboard.rate("plan_early_exit_median_ms", 1e3 * times.early_exit.median_s, where);
}

}  // namespace nanomap::bench
