#pragma once

#include <bitset>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace nanomap {

/// What keeps the vehicle from being flown by us, in the order in which it is worth being told.
enum class Fault : std::uint8_t {
  kEnding,      ///< this process has been told to end
  kHeldUp,      ///< it did not run for a while
  kStalled,     ///< one of its threads does not answer
  kCamera,      ///< nobody has said yet what the camera is
  kDepth,       ///< no depth image, or too old a one
  kDepthStuck,  ///< depth images that show the same picture, while the vehicle moves
  kPose,        ///< no pose, or too old a one
  kClock,       ///< stamps ahead of our time: another clock
  kPlan,        ///< no plan, or too old a one
  kUnsent,      ///< setpoints that do not get out
  kAutopilot,   ///< no autopilot is heard
  kAlignment,   ///< T_NED_W is not known well enough
  kLive,        ///< what we see is a recording, and the autopilot flies a real vehicle
};
inline constexpr std::size_t kFaultCount = 13;

/// In a pilot's words, as what is missing: "depth images".
[[nodiscard]] std::string_view toString(Fault fault);

class FaultSet {
 public:
  FaultSet() = default;

  void add(Fault fault) { bits_.set(static_cast<std::size_t>(fault)); }
  [[nodiscard]] bool has(Fault fault) const { return bits_.test(static_cast<std::size_t>(fault)); }
  [[nodiscard]] bool any() const { return bits_.any(); }
  bool operator==(const FaultSet&) const = default;

  /// "depth images, a plan"
  [[nodiscard]] std::string words() const;

 private:
  std::bitset<kFaultCount> bits_;
};

}  // namespace nanomap
