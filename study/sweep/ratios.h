// A sweep against an earlier one: which settings have become slower or faster.
#pragma once

#include <string>
#include <vector>

#include "study/sweep/statistics.h"
#include "study/sweep/sweep_report.h"

namespace parity::sweep {

struct VariantRatio {
  std::string scene, id;
  Ratio time;                         // of the device time, or of preparation where the knob costs there; now over then
  double flipBefore = 0, flipNow = 0; // FLIP mean against the first path's default
};

struct SweepRatios {
  std::vector<VariantRatio> variants; // those that both have, in this sweep's order
  std::vector<std::string> notes;     // what makes the two hard to compare, what only one has, what is not judged
  double confidence = 0;              // of each interval
  bool anySlower() const;
};

// The intervals hold together with 95 %: each one's error is 5 % divided by their number. Settings are the same where
// all their knobs are. Those with so few rounds that even times without any overlap would be no sure sign are left out,
// with a note. Throws Error (usage) where the two have no setting of any scene in common.
SweepRatios compareSweeps(const SweepReport& before, const SweepReport& now);

} // namespace parity::sweep
