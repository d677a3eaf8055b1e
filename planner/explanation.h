#pragma once

#include <cstdint>
#include <vector>

#include "core/decision.h"
#include "planner/candidates.h"

namespace nanomap {

/// Everything that was found out about one candidate.
struct CandidateExplanation {
  Proposal proposal;
  Vec3 acceleration_L_m_s2 = Vec3::Zero();
  Trajectory trajectory;
  Trajectory brake;
  Verdict verdict;
  double objective = 0.0;  ///< at the motion's full risk, also of what is vetoed
  Evidence evidence;
};

/// A decision, with everything found out about all its candidates, in the order of their indices. No candidates if the
/// state allowed none, the brake alone if nothing else was considered.
struct Explanation {
  Decision decision;
  std::vector<CandidateExplanation> candidates;
};

}  // namespace nanomap
