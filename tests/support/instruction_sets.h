#pragma once

#include <cstdint>
#include <vector>

#include "core/simd.h"
// After simd.h, so that HWY_TARGETS are those that core was compiled for.
#include <hwy/highway.h>

namespace nanomap::test {

/// Every instruction set that core was compiled for and this processor has.
inline std::vector<std::int64_t> instructionSets() {
  std::vector<std::int64_t> out;
  const std::int64_t supported = hwy::SupportedTargets() & HWY_TARGETS;
  for (std::int64_t rest = supported; rest != 0; rest &= rest - 1) out.push_back(rest & -rest);
  return out;
}

/// Core computes with one instruction set while it lives.
class OnInstructionSet {
 public:
  explicit OnInstructionSet(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~OnInstructionSet() { hwy::SetSupportedTargetsForTest(0); }
  OnInstructionSet(const OnInstructionSet&) = delete;
  OnInstructionSet& operator=(const OnInstructionSet&) = delete;
};

}  // namespace nanomap::test
