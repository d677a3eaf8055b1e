#pragma once

#include <cstddef>
#include <vector>

#include "core/pose_buffer.h"
#include "core/snapshot.h"
#include "drivers/recording/log_reader.h"
#include "firmware_app/configuration/configuration.h"
#include "tools/replay/deviation.h"

namespace nanomap {

/// Where to look on the flight's own path.
struct FlownPathParameters {
  int samples = 20;
  Duration step = std::chrono::milliseconds(150);  ///< between samples: 3 s in all
  DeviationModel deviation;
};

/// What the vehicle flew through next, known because the log holds it: the estimator's own later poses. Space that was
/// flown through was free, which makes it the one part of a log whose answers are known beforehand.
class FlownPath {
 public:
  /// Reads the poses of `events`.
  FlownPath(LogReader& log, const std::vector<LogEvent>& events, const Configuration& configuration);

  /// Positions after the snapshot's stamp, in its body frame, soonest first; ends where the log, a gap in its poses or
  /// a jump of the estimator's world ends it.
  [[nodiscard]] std::vector<UncertainPoint> ahead(const ChainSnapshot& snapshot,
                                                  const FlownPathParameters& parameters) const;

 private:
  PoseBuffer poses_;
};

}  // namespace nanomap
