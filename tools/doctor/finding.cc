#include "tools/doctor/finding.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

namespace nanomap::doctor {

std::string_view toString(Verdict verdict) {
  switch (verdict) {
    case Verdict::kOk:
      return "ok";
    case Verdict::kWarning:
      return "warn";
    case Verdict::kFailure:
      return "FAIL";
    case Verdict::kNotLookedAt:
      break;
  }
  return "not looked at";
}

Finding ok(std::string subject, std::string seen) { return {Verdict::kOk, std::move(subject), std::move(seen), {}}; }

Finding warning(std::string subject, std::string seen, std::string fix) {
  return {Verdict::kWarning, std::move(subject), std::move(seen), std::move(fix)};
}

Finding failure(std::string subject, std::string seen, std::string fix) {
  return {Verdict::kFailure, std::move(subject), std::move(seen), std::move(fix)};
}

Finding notLookedAt(std::string subject, std::string why) {
  return {Verdict::kNotLookedAt, std::move(subject), std::move(why), {}};
}

bool anyFailure(std::span<const Finding> findings) {
  return std::ranges::any_of(findings, [](const Finding& f) { return f.verdict == Verdict::kFailure; });
}

std::string toText(std::span<const Finding> findings) {
  const auto count = [&](Verdict verdict) {
    return std::ranges::count_if(findings, [&](const Finding& f) { return f.verdict == verdict; });
  };
  std::string text;
  for (const Finding& finding : findings) {
    fmt::format_to(std::back_inserter(text), "{:<14} {:<18} {}\n", toString(finding.verdict), finding.subject,
                   finding.seen);
    if (!finding.fix.empty()) fmt::format_to(std::back_inserter(text), "{:<14} {:<18} -> {}\n", "", "", finding.fix);
  }
  fmt::format_to(std::back_inserter(text), "{} ok, {} to know, {} to mend, {} not looked at\n", count(Verdict::kOk),
                 count(Verdict::kWarning), count(Verdict::kFailure), count(Verdict::kNotLookedAt));
  return text;
}

}  // namespace nanomap::doctor
