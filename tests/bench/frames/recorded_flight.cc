#include "tests/bench/frames/recorded_flight.h"

#include <stdexcept>
#include <utility>
#include <variant>

namespace nanomap::bench {

Chain chainOf(const RecordedFlight& flight, std::size_t views, std::size_t frames, ViewPool& pool) {
  ChainParameters parameters;
  parameters.history_views = views;
  parameters.pose_capacity = flight.poses.size() + 1;
  Chain chain(parameters);
  for (std::size_t i = 0; i + 1 < flight.poses.size(); ++i) (void)chain.addPose(flight.poses[i]);
  for (std::size_t i = 0; i < frames; ++i) {
    auto view = pool.build(flight.frames[i]);
    if (const auto* fault = std::get_if<ImageFault>(&view)) {
      throw std::invalid_argument("frame " + std::to_string(i) + ": " + std::string(toString(*fault)));
    }
    const Chain::ViewOutcome outcome = chain.addView(std::move(std::get<ViewPtr>(view)));
    if (outcome.waiting || outcome.drop) {
      throw std::invalid_argument("frame " + std::to_string(i) + " does not enter the chain: " +
                                  std::string(outcome.drop ? toString(*outcome.drop) : "no pose is newer"));
    }
  }
  return chain;
}

}  // namespace nanomap::bench
