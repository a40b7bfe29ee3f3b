// One view against the ground truth: its picture, and what it says of both paths, term by term.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/truth.h"
#include "job/displayed.h"
#include "job/scene_renderer.h"

namespace parity::job {

// What is held against the truth.
struct TruthRequest {
  const Displayed &highend, &mobile;
  const base::PixelList& whole;
  const std::vector<const base::PixelList*>& materials; // of frames.coverage
  std::optional<compare::Rect> box;                     // where the report shows only some materials
  float exposureEv = 0;
  bool pictures = false; // whether the FLIP maps are wanted
};

struct TruthComparison {
  Displayed truth;
  compare::Truth whole;                  // images are not named yet
  std::vector<compare::Truth> materials; // as many as asked for, in their order; by the material swap
  base::Image highendFlip, mobileFlip;   // of each path against the truth; empty unless asked for
};

// frames: of all three paths, with their terms.
TruthComparison compareWithTruth(Context& context, const ViewFrames& frames, const TruthRequest& request);

// Which truth it is, in words: for the settings of a report.
std::string describeTruth(const Settings& settings);

} // namespace parity::job
