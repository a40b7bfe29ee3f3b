// Over many materials and scenes: which one set of switches repairs the most.
#pragma once

#include <string>
#include <vector>

#include "study/explain/explanation.h"

namespace parity::explain {

// One set, by its switches' ids, on all materials.
struct TeamSet {
  std::vector<std::string> switches;
  std::size_t within = 0; // materials within their limit
  double meanFlip = 0;    // over all materials
  double operations = 0;  // more a pixel, mean over all materials: the sum of what each switch adds alone
};

struct TeamView {
  std::size_t materials = 0;
  std::vector<TeamSet>
      sets; // of each size from none: the one with most within, then the fewest operations, then the least FLIP
};

// Of the at most kMaxSwitches switches that are worth most over all materials, without those that cheapen. A switch
// that a scene does not have, or that helps nothing there, changes nothing of it. Scenes that failed are left out.
TeamView teamViewOf(const std::vector<SceneExplanation>& scenes);

} // namespace parity::explain
