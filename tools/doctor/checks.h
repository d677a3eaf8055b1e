#pragma once

#include <vector>

#include "tools/doctor/facts.h"
#include "tools/doctor/finding.h"
#include "tools/doctor/floor_evidence.h"
#include "tools/doctor/motion_evidence.h"

/// What the doctor judges. Every check is a function of its arguments: it reads no clock, file or network.
/// @pre where a check is about messages, facts.heard is there; the same holds for machine and autopilot
namespace nanomap::doctor {

using Findings = std::vector<Finding>;

/// Values that are legal, and no one would choose for a flight.
[[nodiscard]] Findings checkConfiguration(const Facts& facts);

/// What was heard on each configured channel; what was not, and where it may be instead.
[[nodiscard]] Findings checkChannels(const Facts& facts);

/// Whose clock stamps are of, and how old they are when they come.
[[nodiscard]] Findings checkClock(const Facts& facts);

/// How often poses and depth frames come, and their gaps.
[[nodiscard]] Findings checkRates(const Facts& facts);

/// Whether there is a pose at each frame's stamp. @pre the clock is right
[[nodiscard]] Findings checkPosesAtFrames(const Facts& facts);

/// Whether frames are those of the camera that is known.
[[nodiscard]] Findings checkCamera(const Facts& facts);

/// Which way is up for the body. @pre there are poses
[[nodiscard]] Findings checkBody(const Facts& facts);

/// Metres per count. @param evidence  null: the motion was not looked at
[[nodiscard]] Findings checkDepthUnit(const Facts& facts, const MotionEvidence* evidence);

/// How the camera is mounted, by how consecutive frames agree, and whether frames and poses keep the same time.
/// @pre evidence.configured: the motion tells something
[[nodiscard]] Findings checkMount(const Facts& facts, const MotionEvidence& evidence);

/// How the camera of a vehicle that stands is mounted, by where the floor is. @pre there is a camera
[[nodiscard]] Findings checkMountAtRest(const Facts& facts, const FloorEvidence& evidence);

/// LCM's network: multicast, reach, and the kernel's buffer.
[[nodiscard]] Findings checkNetwork(const Facts& facts);

[[nodiscard]] Findings checkRealtime(const MachineFacts& machine);
[[nodiscard]] Findings checkDevices(const MachineFacts& machine);
[[nodiscard]] Findings checkDisk(const MachineFacts& machine, const RecorderParameters& recorder);

/// Whether an autopilot is there, and which.
[[nodiscard]] Findings checkAutopilot(const Facts& facts);

/// Its own settings, as far as a flight depends on them. @pre the autopilot was heard
[[nodiscard]] Findings checkParameters(const Facts& facts);

/// The names of what checkParameters() wants to know of that kind of autopilot.
[[nodiscard]] std::vector<std::string> parametersOf(AutopilotKind kind);

}  // namespace nanomap::doctor
