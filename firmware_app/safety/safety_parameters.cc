#include "firmware_app/safety/safety_parameters.h"

#include <stdexcept>
#include <string>

namespace nanomap {
namespace {

void requirePositive(bool positive, const char* key) {
  if (!positive) throw std::invalid_argument("[safety]: " + std::string(key) + " must be above 0");
}

}  // namespace

void check(const SafetyParameters& parameters) {
  requirePositive(parameters.max_plan_age > Duration::zero(), "max_plan_age_s");
  requirePositive(parameters.max_depth_age > Duration::zero(), "max_depth_age_s");
  requirePositive(parameters.max_pose_age > Duration::zero(), "max_pose_age_s");
  requirePositive(parameters.max_step > Duration::zero(), "max_step_s");
  requirePositive(parameters.standstill_m_s > 0.0, "standstill_m_s");
  if (parameters.patience < parameters.critical_after) {
    throw std::invalid_argument("[safety]: patience_s must not be below critical_after_s: the pilot is warned first");
  }
}

}  // namespace nanomap
