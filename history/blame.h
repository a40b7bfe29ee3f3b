// The last change of a subject: between which runs and commits, and what else changed there.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "history/subject.h"

namespace parity::history {

struct FigureStep {
  std::string metric;
  double before = 0, now = 0;
};

struct InputStep {
  std::string what;        // "asset", "build", ...: as causesOf() names it
  std::string before, now; // digests, or texts; empty: there was none
};

struct Blame {
  SubjectRef subject;
  RunRef first, newest;   // runs that showed it
  bool isChanged = false; // else all below but `runs` is empty
  RunRef before, now;     // the last run with the old value, the first one with the new value
  std::string kind;       // of the event: "regressed", ...
  std::vector<FigureStep> figures;
  std::string verdictBefore, verdictNow; // the same where it did not change
  std::vector<InputStep> inputs;         // what changed between the two
  bool isNondeterministic = false;       // figures changed, and nothing that decides them
  std::size_t runs = 0;                  // that showed the subject since then, or at all
};

// metric: only the changes of this figure; empty: the last change of any figure or of the verdict. Throws Error (usage)
// for a subject or metric that the index does not have.
Blame blame(const Database& index, const std::string& path, const std::string& metric, const Where& where);

} // namespace parity::history
