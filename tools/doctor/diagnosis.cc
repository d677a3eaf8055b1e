#include "tools/doctor/diagnosis.h"

#include <initializer_list>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

namespace nanomap::doctor {
namespace {

constexpr const char* kLogOnly = "a log tells nothing of it: without a log, on the vehicle, it is looked at";

void append(Findings& all, Findings some) {
  all.insert(all.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
}

void skip(Findings& all, std::initializer_list<const char*> subjects, const std::string& why) {
  for (const char* subject : subjects) all.push_back(notLookedAt(subject, why));
}

/// Of what moves: needs right stamps, upright poses and a camera that fits the frames.
Findings checkMotion(const Facts& facts, bool ready) {
  Findings findings;
  const auto camera = facts.camera();
  std::optional<MotionEvidence> evidence;
  if (ready) evidence = motionEvidence(*facts.heard, *camera, facts.configuration.chain.max_pose_gap);
  append(findings, checkDepthUnit(facts, evidence ? &*evidence : nullptr));
  if (!evidence || anyFailure(findings)) {
    skip(findings, {"mount"}, "first mend what has failed above");
  } else if (evidence->configured) {
    append(findings, checkMount(facts, *evidence));
  } else {
    const Duration max_pose_gap = facts.configuration.chain.max_pose_gap;
    append(findings, checkMountAtRest(facts, floorEvidence(*facts.heard, CameraModel(*camera), max_pose_gap)));
  }
  return findings;
}

Findings checkMessages(const Facts& facts) {
  if (!facts.heard) {
    Findings findings;
    skip(findings, {"channels", "clock", "rates", "poses of frames", "camera", "body axes", "depth unit", "mount"},
         "nothing could be heard");
    return findings;
  }
  Findings findings = checkChannels(facts);
  const Findings clock = checkClock(facts);
  append(findings, clock);
  append(findings, checkRates(facts));
  if (anyFailure(clock)) {
    skip(findings, {"poses of frames"}, "first mend the clock");
  } else {
    append(findings, checkPosesAtFrames(facts));
  }
  if (facts.heard->poses.empty()) {
    skip(findings, {"body axes"}, "no poses were heard");
  } else {
    append(findings, checkBody(facts));
  }
  const bool frames_wait_for_camera = !facts.camera() && anyFailure(findings);
  if (frames_wait_for_camera) {
    skip(findings, {"camera", "depth unit", "mount"}, "no camera was heard of");
    return findings;
  }
  const Findings camera = checkCamera(facts);
  append(findings, camera);
  if (anyFailure(camera)) {
    skip(findings, {"depth unit", "mount"}, "first mend the camera");
    return findings;
  }
  append(findings, checkMotion(facts, !anyFailure(findings)));
  return findings;
}

}  // namespace

Findings diagnose(const Facts& facts) {
  Findings findings = checkConfiguration(facts);
  append(findings, checkMessages(facts));
  if (facts.heard && facts.heard->from_log) {
    skip(findings, {"network", "receive buffer", "real time", "devices", "disk", "autopilot", "parameters"}, kLogOnly);
    return findings;
  }
  append(findings, checkNetwork(facts));
  if (facts.machine) {
    append(findings, checkRealtime(*facts.machine));
    append(findings, checkDevices(*facts.machine));
    append(findings, checkDisk(*facts.machine, facts.configuration.recorder));
  }
  if (facts.autopilot) {
    append(findings, checkAutopilot(facts));
    if (facts.autopilot->state.linked) {
      append(findings, checkParameters(facts));
    } else {
      skip(findings, {"parameters"}, "the autopilot was not heard");
    }
  }
  return findings;
}

}  // namespace nanomap::doctor
