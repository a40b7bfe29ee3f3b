// One view of a scene by every set of switches, over the very same surfaces.
#pragma once

#include <string>
#include <vector>

#include "compare/verdict/budget.h"
#include "job/scene_request.h"
#include "study/explain/explanation.h"

namespace parity::job {
class Context;
}

namespace parity::explain {

// Effects on mean FLIP below this are none.
inline constexpr double kLeastEffect = 0.001;

struct ExplainWish {
  std::vector<std::string> switches = {};  // as --switch takes them, at most kMaxSwitches; none: of what is proposed
                                           // those that change most
  std::vector<std::string> materials = {}; // names; none: those of the settings
  bool illustrates = false;                // pictures are made, too
};

// Of the request's first view. budgets: what is over budget, by the limits of flip.mean. The first path of the settings
// is what is held against, the second the one whose switches are turned; there are no others. One program renders all
// sets, whose knobs are data (docs/explain.md); what a sentence says is rendered again by the programs specialised to
// it. Throws Error: usage for switches that cannot be used and for other paths; notComparable where no chosen material
// is seen; as job::prepareScene does.
SceneExplanation explainScene(job::Context& context, const job::SceneRequest& request, const ExplainWish& wish,
                              const compare::Budgets& budgets, const job::Progress& progress);

} // namespace parity::explain
