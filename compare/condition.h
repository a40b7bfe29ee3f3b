// What decides the figures of a run: named settings, and how those of two runs differ.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace parity::compare {

// The figures that change with a condition.
enum class ActsOn {
  figures, // all but the truth's
  wholes,  // those of whole images alone
  truth,   // those against the truth alone
  nothing, // none: it decides what else a result holds, so it is in no report
};
const char* nameOf(ActsOn actsOn); // "figures", "whole images", "truth", "nothing"
std::optional<ActsOn> actsOnByName(std::string_view name);

struct Condition {
  std::string name;
  std::string value; // reads back as the very same; no folder of this machine, but for one that acts on nothing
  ActsOn actsOn = ActsOn::figures;
  std::string words = {}; // the value for people; empty: the value says it
  const std::string& text() const { return words.empty() ? value : words; }
};

// A condition that is not the same in two runs, or that one of them has not recorded.
struct ConditionDifference {
  ActsOn actsOn = ActsOn::figures;
  std::string sentence; // "environment rotation was 0, is 90"
};

// By name: in the order of `now`, then what `before` alone has.
std::vector<ConditionDifference> differencesOf(const std::vector<Condition>& before, const std::vector<Condition>& now);

} // namespace parity::compare
