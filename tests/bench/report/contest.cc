#include "tests/bench/report/contest.h"

#include <time.h>

#include <algorithm>
#include <limits>

#include "tools/replay/percentile.h"

namespace nanomap::bench {

double threadTime_s() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

namespace {

double timeRun_s(const Contestant& contestant) {
  if (contestant.prepare) contestant.prepare();
  const double start_s = threadTime_s();
  contestant.run();
  return threadTime_s() - start_s;
}

}  // namespace

std::vector<Standing> hold(const Contest& contest, int rounds) {
  struct Times {
    std::vector<double> settled_s;
    std::vector<double> cold_s;
  };
  std::vector<Times> times(contest.contestants.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < contest.contestants.size(); ++i) {
      const Contestant& contestant = contest.contestants[i];
      times[i].cold_s.push_back(timeRun_s(contestant) / contestant.items);
      (void)timeRun_s(contestant);
      times[i].settled_s.push_back(timeRun_s(contestant) / contestant.items);
    }
  }
  std::vector<Standing> standings;
  for (std::size_t i = 0; i < times.size(); ++i) {
    standings.push_back({contest.contestants[i].name, percentile<double>(times[i].settled_s, 0.5),
                         percentile<double>(times[i].cold_s, 0.5)});
  }
  return standings;
}

double ratio(const std::vector<Standing>& standings, const std::string& opponent) {
  double best_s = std::numeric_limits<double>::infinity();
  for (auto standing = standings.begin() + 1; standing != standings.end(); ++standing) {
    if (standing->contestant.starts_with(opponent)) best_s = std::min(best_s, standing->median_s);
  }
  return best_s / standings.front().median_s;
}

}  // namespace nanomap::bench
