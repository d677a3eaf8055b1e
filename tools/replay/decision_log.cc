#include "tools/replay/decision_log.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "drivers/lcm/decode.h"
#include "drivers/recording/log_reader.h"

namespace nanomap {

std::vector<decision_t> readDecisions(const std::vector<std::filesystem::path>& parts) {
  LogReader log(parts);
  const std::string name = parts.front().string();
  std::vector<decision_t> decisions;
  std::vector<std::uint8_t> message;
  for (const LogEvent& event : log.events()) {
    log.read(event, message);
    if (messageHash(message) != decision_t::getHash()) continue;
    Decoded<decision_t> decoded = decode<decision_t>(message);
    if (const auto* fault = std::get_if<DecodeFault>(&decoded)) {
      throw std::runtime_error(
          fmt::format("{}: decision {} is damaged ({}): write the log anew", name, decisions.size(), toString(*fault)));
    }
    decisions.push_back(std::get<decision_t>(std::move(decoded)));
  }
  if (decisions.empty()) {
    throw std::runtime_error(name + ": holds no decision: nanomap-replay --decisions writes such a log");
  }
  return decisions;
}

}  // namespace nanomap
