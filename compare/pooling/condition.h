// What decides the figures of a run: named settings, and how those of two runs differ.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/knob/knob.h"

namespace parity::compare {

using base::ActsOn;
const char* nameOf(ActsOn actsOn); // "figures", "whole images", "truth", "nothing"

struct Condition {
  std::string name;
  std::string value; // reads back as the very same; no folder of this machine, but for one that acts on nothing
  ActsOn actsOn = ActsOn::figures;
  std::string words = {}; // the value for people; empty: the value says it
  const std::string& text() const { return words.empty() ? value : words; }
};

// A condition that is not the same in two runs, or that one of them has not recorded.
struct ConditionDifference {
  std::string name;
  ActsOn actsOn = ActsOn::figures;
  std::string sentence; // "environment rotation was 0, is 90"
};

// Those of a run, where a scene of it says nothing else.
std::vector<Condition> overlaid(const std::vector<Condition>& ofRun, const std::vector<Condition>& ofScene);

// By name: in the order of `now`, then what `before` alone has.
std::vector<ConditionDifference> differencesOf(const std::vector<Condition>& before, const std::vector<Condition>& now);

} // namespace parity::compare
