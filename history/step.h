// Whether a report holds limits: what `git bisect run` asks at each commit.
#pragma once

#include <string>
#include <vector>

#include "compare/pooling/statistic.h"
#include "report/report.h"

namespace parity::history {

struct StepLimit {
  compare::Statistic figure;
  double most = 0; // least, where more is better (psnr); of the absolute value where it has a sign
};

// "flip.mean=.062". Throws Error (usage) for an unknown figure (with the nearest name) or what is no number.
StepLimit readLimit(const std::string& text);

// Which rows are judged. Globs, none: all.
struct StepChoice {
  std::vector<std::string> views = {};     // "SCENE/VIEW" (report/view_choice.h)
  std::vector<std::string> materials = {}; // names
  bool wholes = false;                     // whole images, not materials
};

struct StepVerdict {
  enum Kind { good, bad, untestable } kind = untestable;
  std::string reason; // one line
};

// bad: a row is beyond a limit. untestable: none is, but one could not be judged (its scene failed, its figure was not
// measured or is no number), or there is no such row. Rows that show no pixel do not count.
StepVerdict judgeStep(const report::Report& report, const std::vector<StepLimit>& limits, const StepChoice& choice);

} // namespace parity::history
