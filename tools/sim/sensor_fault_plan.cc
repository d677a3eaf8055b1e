#include "tools/sim/sensor_fault_plan.h"

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace nanomap::sim {
namespace {

/// "A:B", both positive.
std::pair<double, double> parsePair(std::string_view option, std::string_view text, const char* meaning) {
  double first = 0.0;
  double second = 0.0;
  const char* const end = text.data() + text.size();
  const auto colon = std::from_chars(text.data(), end, first);
  const bool two = colon.ec == std::errc() && colon.ptr != end && *colon.ptr == ':';
  const auto rest = two ? std::from_chars(colon.ptr + 1, end, second) : colon;
  if (!two || rest.ec != std::errc() || rest.ptr != end || !(first >= 0.0) || !(second > 0.0) ||
      !std::isfinite(first + second)) {
    throw std::invalid_argument(std::string(option) + " " + std::string(text) + ": give " + meaning);
  }
  return {first, second};
}

}  // namespace

Outage parseOutage(std::string_view option, std::string_view text) {
  const auto [after_s, lasts_s] = parsePair(option, text, "seconds after the departure and seconds, as in 5:1");
  return {fromSeconds(after_s), fromSeconds(lasts_s)};
}

Jump parseJump(std::string_view option, std::string_view text) {
  const auto [after_s, distance_m] = parsePair(option, text, "seconds after the departure and metres, as in 5:1");
  return {fromSeconds(after_s), distance_m};
}

generate::SensorFaults SensorFaultPlan::at(Time stamp, std::optional<Time> departure) {
  if (!departure) return {};
  const Duration since_departure = stamp - *departure;
  generate::SensorFaults faults;
  faults.camera_off = parameters_.camera && parameters_.camera->holds(since_departure);
  faults.estimator_off = parameters_.estimator && parameters_.estimator->holds(since_departure);
  if (parameters_.jump && !jumped_ && since_departure >= parameters_.jump->after) {
    jumped_ = true;
    faults.jump_m = parameters_.jump->distance_m;
  }
  return faults;
}

}  // namespace nanomap::sim
