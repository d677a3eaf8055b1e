#pragma once

#include <cstddef>

#include "tools/replay/playback.h"

namespace nanomap {

/// Event by event, merged by log time, each taken in as it arrived. A plan is made whenever a view enters the chain.
/// What is said once and holds from then on, camera models and goals, is taken in from before the span too.
class ArrivalPlayback final : public Playback {
 public:
  ArrivalPlayback(LogReader& log, const Configuration& configuration, const LogSpan& span);

  [[nodiscard]] std::optional<Time> nextStamp() const override;
  Progress advance() override;

 private:
  std::size_t next_ = 0;
  std::uint64_t plans_ = 0;
};

}  // namespace nanomap
