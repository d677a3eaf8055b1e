#include "tools/replay/decision_diff.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <limits>

#include "core/status.h"
#include "tools/replay/text.h"

namespace nanomap {
namespace {

constexpr double kMicrosecondsPerSecond = 1e6;

struct Field {
  std::string name;
  bool consumed;
  std::function<std::string(const decision_t&)> text;
};

template <class Member>
Field field(std::string name, Member member, bool consumed = false) {
  return {std::move(name), consumed, [member](const decision_t& d) { return fmt::format("{}", d.*member); }};
}

/// A number that holds only if a flag says so.
template <class Flag, class Member>
Field optionalField(std::string name, Flag flag, Member member, bool consumed = false) {
  return {std::move(name), consumed, [flag, member](const decision_t& d) {
            return d.*flag != 0 ? fmt::format("{}", d.*member) : std::string("none");
          }};
}

std::string trajectoryText(const trajectory_t& trajectory) {
  std::string text = fmt::format("at {} from {} {} {}", trajectory.utime, trajectory.position, trajectory.velocity,
                                 trajectory.acceleration);
  for (std::size_t i = 0; i < trajectory.piece_duration.size(); ++i) {
    text += fmt::format(", {} s of {}", trajectory.piece_duration[i], trajectory.piece_jerk[i]);
  }
  return text;
}

std::vector<Field> makeFields() {
  using D = decision_t;
  std::vector<Field> fields = {
      field("step", &D::step, true),
      field("flown", &D::flown, true),
      field("state_sequence", &D::state_sequence, true),
      field("pose_sequence", &D::pose_sequence, true),
      field("epoch", &D::epoch, true),
      field("num_views", &D::num_views, true),
      optionalField("newest_view_sequence", &D::has_view, &D::newest_view_sequence, true),
      optionalField("correction_sequence", &D::has_correction, &D::correction_sequence, true),
      optionalField("goal_sequence", &D::has_goal, &D::goal_sequence, true),
      field("reason", &D::reason),
      optionalField("primitive", &D::has_motion, &D::primitive),
      {"trajectory", false, [](const D& d) { return trajectoryText(d.trajectory); }},
      field("yaw", &D::yaw),
      field("yaw_rate", &D::yaw_rate),
      field("risk", &D::risk),
      {"has_brake", false, [](const D& d) { return std::string(d.has_brake != 0 ? "yes" : "no"); }},
      {"brake", false, [](const D& d) { return trajectoryText(d.brake); }},
      field("brake_risk", &D::brake_risk),
      field("num_candidates", &D::num_candidates),
      field("num_evaluated", &D::num_evaluated),
      field("num_feasible", &D::num_feasible),
  };
  for (std::size_t i = 0; i < kStatusCount; ++i) {
    fields.push_back({fmt::format("vetoes ({})", toString(static_cast<Status>(i))), false, [i](const D& d) {
                        return i < d.vetoes.size() ? fmt::format("{}", d.vetoes[i]) : std::string("none");
                      }});
  }
  fields.push_back(field("vetoes_neighbours", &D::vetoes_neighbours));
  fields.push_back(field("vetoes_of_brakes", &D::vetoes_of_brakes));
  return fields;
}

const std::vector<Field>& allFields() {
  static const std::vector<Field> fields = makeFields();
  return fields;
}

/// Collects differences in the order of time.
class Comparison {
 public:
  Comparison() {
    for (const Field& field : allFields()) differences_.push_back({.field = field.name, .consumed = field.consumed});
  }

  void compare(const decision_t& a, const decision_t& b) {
    bool different = false;
    for (std::size_t i = 0; i < differences_.size(); ++i) {
      std::string text_a = allFields()[i].text(a);
      std::string text_b = allFields()[i].text(b);
      if (text_a == text_b) continue;
      different = true;
      FieldDifference& difference = differences_[i];
      if (difference.count++ > 0) continue;
      difference.first_utime = a.utime;
      difference.first_a = std::move(text_a);
      difference.first_b = std::move(text_b);
    }
    if (!different) return;
    ++diff.different;
    noteParting(a.utime);
  }

  void noteParting(std::int64_t utime) {
    if (!parted_) diff.first_utime = utime;
    parted_ = true;
  }

  [[nodiscard]] DecisionDiff take() {
    for (FieldDifference& difference : differences_) {
      if (difference.count > 0) diff.fields.push_back(std::move(difference));
    }
    return std::move(diff);
  }

  DecisionDiff diff;

 private:
  std::vector<FieldDifference> differences_;
  bool parted_ = false;
};

std::int64_t firstUtime(std::span<const decision_t> decisions) {
  return decisions.empty() ? std::numeric_limits<std::int64_t>::max() : decisions.front().utime;
}

double secondsFrom(std::int64_t start_utime, std::int64_t utime) {
  return static_cast<double>(utime - start_utime) / kMicrosecondsPerSecond;
}

}  // namespace

DecisionDiff compareDecisions(std::span<const decision_t> a, std::span<const decision_t> b) {
  Comparison comparison;
  comparison.diff.in_a = a.size();
  comparison.diff.in_b = b.size();
  comparison.diff.start_utime = std::min(firstUtime(a), firstUtime(b));
  auto in_a = a.begin();
  auto in_b = b.begin();
  while (in_a != a.end() || in_b != b.end()) {
    if (in_b == b.end() || (in_a != a.end() && in_a->utime < in_b->utime)) {
      ++comparison.diff.only_in_a;
      comparison.noteParting((in_a++)->utime);
    } else if (in_a == a.end() || in_b->utime < in_a->utime) {
      ++comparison.diff.only_in_b;
      comparison.noteParting((in_b++)->utime);
    } else {
      comparison.compare(*in_a++, *in_b++);
    }
  }
  return comparison.take();
}

std::string toText(const DecisionDiff& diff) {
  Text text;
  text.line("decisions: {} in A, {} in B", diff.in_a, diff.in_b);
  if (diff.same()) {
    text.line("all are the same");
    return text.take();
  }
  text.line(
      "they part {:.3f} s after the first decision (utime {}); {} of those in both differ, {} are in A only, {} in "
      "B only",
      secondsFrom(diff.start_utime, diff.first_utime), diff.first_utime, diff.different, diff.only_in_a,
      diff.only_in_b);
  const bool other_inputs = std::any_of(diff.fields.begin(), diff.fields.end(), [&](const FieldDifference& field) {
    return field.consumed && field.first_utime == diff.first_utime;
  });
  if (diff.different > 0) {
    text.line("why, at first: {}", other_inputs
                                       ? "other inputs were consumed"
                                       : "the same inputs were consumed; the configuration, the goal's place or "
                                         "the program is another");
  }
  for (const FieldDifference& field : diff.fields) {
    text.line("  {:<22}{:>8} differ, first after {:.3f} s", field.field, field.count,
              secondsFrom(diff.start_utime, field.first_utime));
    text.line("    A: {}", field.first_a);
    text.line("    B: {}", field.first_b);
  }
  return text.take();
}

}  // namespace nanomap
