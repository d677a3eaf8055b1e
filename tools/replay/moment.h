#pragma once

#include <optional>

#include "core/goal.h"
#include "core/snapshot.h"
#include "core/vehicle_state.h"
#include "firmware_app/pipeline/pipeline.h"

namespace nanomap {

/// What a plan is made of at one point of a log.
struct Moment {
  Time now{};  ///< the time planned for
  ChainSnapshot snapshot;
  VehicleState state;
  std::optional<Goal> goal;
};

/// Writes the pipeline's present state to `moment`, reusing its storage.
/// @param now         empty: the snapshot's time
/// @param other_goal  taken instead of the log's, in whatever world the vehicle is in
/// @pre the pipeline has accepted a pose
void takeMoment(const Pipeline& pipeline, std::optional<Time> now, const std::optional<Goal>& other_goal,
                Moment& moment);

}  // namespace nanomap
