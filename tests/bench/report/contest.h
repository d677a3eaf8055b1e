#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace nanomap::bench {

/// One way to do a piece of work.
struct Contestant {
  std::string name;
  double items = 1.0;                  ///< queries, frames, pixels: what one run is divided by
  std::function<void()> run;           ///< timed
  std::function<void()> prepare = {};  ///< before each run, untimed
};

/// A row of the table that a contest decides, against the fastest contestant whose name begins with `opponent`.
struct Rating {
  std::string row;
  std::string opponent;
};

/// The same work done in several ways. The first contestant is ours.
struct Contest {
  std::string name;
  std::vector<Contestant> contestants;
  std::vector<Rating> ratings;
  bool is_long = false;  ///< tens of milliseconds a run, which repeats better
};

struct Standing {
  std::string contestant;
  double median_s = 0.0;  ///< an item
  double cold_s = 0.0;    ///< an item: the same of the first runs of the turns
};

/// Processor time that the calling thread has used [s]: other programs on the machine do not count.
[[nodiscard]] double threadTime_s();

/// All contestants in turn, `rounds` times, so that what slows the machine down slows all of them down. What counts is
/// the third run of a turn: it finds the caches as its own work leaves them, as in flight, and not as an opponent of
/// several hundred megabytes does. One run before it is too few, since a last-level cache may keep only what is used
/// again. The first run is reported too.
[[nodiscard]] std::vector<Standing> hold(const Contest& contest, int rounds);

/// The fastest of those whose name begins with `opponent`, divided by ours. @pre there is one
[[nodiscard]] double ratio(const std::vector<Standing>& standings, const std::string& opponent);

}  // namespace nanomap::bench
