#include "tools/doctor/gather_live.h"

#include <exception>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "drivers/lcm/lcm_network.h"
#include "drivers/lcm/lcm_url.h"
#include "drivers/mavlink/mavlink_link.h"
#include "drivers/mavlink/mavsdk_log.h"
#include "firmware_app/flight/process_clock.h"
#include "tools/doctor/checks.h"
#include "tools/doctor/gather_machine.h"
#include "tools/doctor/listener.h"

namespace nanomap::doctor {
namespace {

/// Keeps asking the autopilot for what it has not told.
class AutopilotSurvey {
 public:
  explicit AutopilotSurvey(const LinkParameters& parameters) {
    try {
      link_.emplace(parameters, processNow);
    } catch (const PortTaken& error) {
      facts_.fault = error.what();
      facts_.port_taken = true;
    } catch (const std::exception& error) {
      facts_.fault = error.what();
    }
  }

  void step(Time now) {
    constexpr Duration kPeriod = std::chrono::milliseconds(100);
    constexpr Duration kAskAgain = std::chrono::milliseconds(500);
    if (!link_ || now < next_step_) return;
    next_step_ = now + kPeriod;
    link_->keepAlive(SystemStatus::kBoot);
    if (now < next_question_) return;
    next_question_ = now + kAskAgain;
    for (const std::string& name : parametersOf(link_->autopilot().kind)) {
      if (!link_->parameter(name)) (void)link_->requestParameter(name);
    }
  }

  [[nodiscard]] AutopilotFacts finish() && {
    if (!link_) return std::move(facts_);
    facts_.state = link_->autopilot();
    facts_.other_system = link_->otherAutopilot();
    for (const std::string& name : parametersOf(facts_.state.kind)) {
      facts_.parameters[name] = link_->parameter(name);
    }
    return std::move(facts_);
  }

 private:
  std::optional<MavlinkLink> link_;
  AutopilotFacts facts_;
  Time next_step_{};
  Time next_question_{};
};

LinkParameters linkOf(const Configuration& configuration, std::uint8_t component_id) {
  LinkParameters link = configuration.mavlink.link;
  if (component_id == link.component_id) {
    throw std::invalid_argument("--component-id " + std::to_string(component_id) +
                                " is that of the flight process (mavlink.component_id): give another one");
  }
  link.component_id = component_id;
  return link;
}

/// Null if there is none, which `facts` tells then.
std::unique_ptr<LcmNetwork> openNetwork(Facts& facts) {
  try {
    return std::make_unique<LcmNetwork>(facts.configuration.lcm.url, kEveryChannel);
  } catch (const std::exception& error) {
    facts.lcm_fault = error.what();
    return nullptr;
  }
}

}  // namespace

void gatherLive(Facts& facts, std::uint8_t component_id, Duration listen) {
  constexpr Duration kLongestWait = std::chrono::milliseconds(20);
  const MavsdkLog quiet([](MavsdkLog::Level, std::string_view) {});
  const std::unique_ptr<LcmNetwork> network = openNetwork(facts);
  AutopilotSurvey survey(linkOf(facts.configuration, component_id));

  const Time start = processNow();
  Listener listener(facts.configuration.lcm, start, listen);
  for (Time now = start; now < start + listen; now = processNow()) {
    survey.step(now);
    if (!network) {
      sleepUntil(now + kLongestWait);
      continue;
    }
    (void)network->wait(kLongestWait, [&](const ReceivedMessage& message) { listener.take(message, processNow()); });
  }
  facts.autopilot = std::move(survey).finish();
  if (!network) return;
  facts.heard = std::move(listener).finish();
  facts.heard->realtime_ahead = realtimeAhead();
  facts.receive_buffer = ReceiveBuffer{.wanted_bytes = parseLcmUrl(facts.configuration.lcm.url).receive_buffer_bytes,
                                       .granted_bytes = network->receiveBufferBytes(),
                                       .limit_bytes = receiveBufferLimit(),
                                       .lost = network->loss().datagrams};
}

}  // namespace nanomap::doctor
