#pragma once

#include <gmock/gmock.h>

#include <set>
#include <string>

#include "tools/doctor/diagnosis.h"

namespace nanomap::test {

/// The subjects of what has failed.
inline std::set<std::string> failed(const doctor::Findings& findings) {
  std::set<std::string> subjects;
  for (const doctor::Finding& finding : findings) {
    if (finding.verdict == doctor::Verdict::kFailure) subjects.insert(finding.subject);
  }
  return subjects;
}

/// What the report says to do about the failures of one subject.
inline std::string fixOf(const doctor::Findings& findings, const std::string& subject) {
  std::string fixes;
  for (const doctor::Finding& finding : findings) {
    if (finding.subject == subject && finding.verdict == doctor::Verdict::kFailure) fixes += finding.fix + "\n";
  }
  return fixes;
}

}  // namespace nanomap::test
