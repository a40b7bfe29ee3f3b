// A sweep over many scenes in one table: each setting by its median and its worst.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "study/sweep/sweep_report.h"

namespace parity::sweep {

// Of figures of many scenes; both 0 for none.
struct MedianWorst {
  double median = 0, worst = 0;
};

// One setting over the scenes that have it.
struct SettingSummary {
  std::string id; // "mobile: preset refit"
  std::size_t scenes = 0;
  double time = 0;              // device time of shading over that of its path's default, median; 0: not of shading
  MedianWorst flip, relMse;     // against the truth; of scenes with one
  MedianWorst fromFirst;        // mean FLIP against the default of the first path
  MedianWorst fromFirstOfParts; // the same, of every material of every scene
};

// In the order in which settings are first met. Scenes that failed are left out.
std::vector<SettingSummary> summarise(const SweepReport& report);

// What a reader of figures over many scenes must know, one sentence each: scenes that were not measured with the
// reason, scenes without truth, and paths whose default is another one in some scenes, with the knobs that differ.
std::vector<std::string> notesOf(const SweepReport& report);

// The notes, the summary, then FLIP of every setting in every scene, as Markdown: against the truth where every scene
// has one.
std::string toMarkdown(const SweepReport& report);

} // namespace parity::sweep
