#pragma once

#include <span>

#include "core/geometry.h"

namespace nanomap {

/// A pose to be composed with one that is interpolated first. Borrows everything, and writes `result`.
struct PoseJob {
  const Pose* from = nullptr;  ///< interpolated from,
  double weight_of_to = 1.0;  ///< 0 to 1; keeps the ends apart, which two stores write and no vector shall read at once
  const Pose* to = nullptr;   ///< to
  const Pose* pose = nullptr;
  Pose* result = nullptr;
};

// Many at a time: vector code, chosen at run time. Every instruction set gives the same bits, and core/geometry.h the
// same but for the last few. No job may read what another one writes. Allocates: no. Threads: any number.

/// result = pose * interpolated^-1, made unit: T_Wnew_Wold, of T_Wnew_B and T_Wold_B.
void makeDeltas(std::span<const PoseJob> jobs);

/// result = interpolated * pose: T_Wnew_S, of T_Wnew_Wold and T_Wold_S.
void applyDeltas(std::span<const PoseJob> jobs);

}  // namespace nanomap
