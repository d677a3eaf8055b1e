#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace nanomap::doctor {

enum class Verdict : std::uint8_t {
  kOk,
  kWarning,      ///< it flies, but someone should know
  kFailure,      ///< it does not fly, or not safely
  kNotLookedAt,  ///< the finding says why
};
[[nodiscard]] std::string_view toString(Verdict verdict);

/// One line of the doctor's report.
struct Finding {
  Verdict verdict = Verdict::kOk;
  std::string subject;  ///< what was looked at, in a word or two
  std::string seen;     ///< figures with units; of something not looked at: why
  std::string fix;      ///< what to do, with the exact key, command or parameter; empty: nothing
};

[[nodiscard]] Finding ok(std::string subject, std::string seen);
[[nodiscard]] Finding warning(std::string subject, std::string seen, std::string fix);
[[nodiscard]] Finding failure(std::string subject, std::string seen, std::string fix);
[[nodiscard]] Finding notLookedAt(std::string subject, std::string why);

[[nodiscard]] bool anyFailure(std::span<const Finding> findings);

/// A line a finding, its fix on the next one, and a last line that counts them.
[[nodiscard]] std::string toText(std::span<const Finding> findings);

}  // namespace nanomap::doctor
