#pragma once

#include <cstdint>
#include <optional>

#include "core/decision.h"
#include "core/goal.h"
#include "core/snapshot.h"
#include "core/vehicle_state.h"
#include "core/view.h"
#include "firmware_app/pipeline/message_intake.h"
#include "firmware_app/pipeline/view_builder.h"

/// What the stages hand to each other. Everything that came from outside carries its arrival, by which a recording
/// tells it: whole microseconds of the process's clock, no two alike.
namespace nanomap {

/// A pose, a correction or a goal, for the chain.
struct ArrivedInput {
  Time arrival{};
  Duration stamp_shift{};  ///< that its stamps were moved by, from their own clock to ours
  Input input;
};

/// A depth frame, from its source over the capture stage to the index.
struct ArrivedFrame {
  Time arrival{};
  Duration stamp_shift{};
  DepthInput depth;
};

/// What the camera says of itself, for the index.
struct ArrivedCamera {
  Time arrival{};
  CameraInput camera;
};

/// What became of a frame or a camera model in the index stage, for the chain.
struct IndexedFrame {
  Time arrival{};
  Duration stamp_shift{};
  InputKind kind = InputKind::kDepth;  ///< or kCamera
  ViewPtr view;                        ///< null for a camera model, and for a frame that could not become one
  bool camera_known = false;
};

/// All that one plan is made from.
struct PlanningMoment {
  ChainSnapshot snapshot;
  VehicleState state;
  std::optional<Goal> goal;
  std::uint64_t step = 0;  ///< the last one that the snapshot knows of
  Time newest_view{};      ///< exposure, for latencies
  Time newest_frame{};     ///< arrival, for the deadline
};

/// A decision as it was made.
struct MadeDecision {
  Decision decision;
  std::uint64_t sequence = 0;
  std::uint64_t step = 0;
  bool flown = false;  ///< the vehicle was ours: the plan went on from the motion in force
};

}  // namespace nanomap
