// One view against the ground truth: its picture, and what it says of two paths, term by term.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "compare/metrics/truth.h"
#include "job/scene/scene_renderer.h"
#include "job/view/displayed.h"

namespace parity::job {

// What is held against the truth.
struct TruthRequest {
  const Displayed &reference, &test; // of the first path, and of the one that is compared with it
  const base::PixelList& whole;
  const std::vector<const base::PixelList*>& materials; // of frames.coverage
  std::optional<compare::Rect> box;                     // where the report shows only some materials
  float exposureEv = 0;
  double wantedError = 0;                // relative standard error
  bool pictures = false;                 // whether the FLIP maps are wanted
  std::string referenceTitle, testTitle; // paths::Path::title()
};

struct TruthComparison {
  Displayed truth;
  compare::Truth whole;                  // images are not named yet
  std::vector<compare::Truth> materials; // as many as asked for, in their order; by the material swap
  base::Image referenceFlip, testFlip;   // of each path against the truth; empty unless asked for
};

// frames: the truth and its terms. reference, test: of the frames, with their swaps of the truth; terms are compared
// where both have them.
TruthComparison compareWithTruth(Context& context, const ViewFrames& frames, const PathFrames& reference,
                                 const PathFrames& test, const TruthRequest& request);

} // namespace parity::job
