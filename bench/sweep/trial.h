// One scene by every setting, over the very same surface buffer: times, costs and errors.
#pragma once

#include "job/context.h"
#include "job/prepared_scene.h"
#include "job/settings.h"
#include "sweep/sweep_report.h"

namespace parity::sweep {

struct TrialOptions {
  int rounds = 9;                    // that are timed, after one that warms up
  int preparationRounds = 3;         // of what is prepared once
  bool truth = true;                 // also shade the reference path, for errors against it
  std::vector<std::string> settings; // globs over ids ("mobile: refit*"); empty: all. Both defaults are always there
};

// Shades every setting in random order, round after round, so that drift falls on all alike. Errors are of what the
// screen shows (FLIP) and of exposed light (relMSE), over the pixels that the scene covers and by material. context:
// its settings say size, view, device and the defaults of both paths; with `costs` shaders are counted. Throws Error as
// job::prepareScene does, (usage) for globs that match nothing.
SceneSweep runTrial(job::Context& context, const job::SceneRequest& request, const TrialOptions& options,
                    const job::Progress& progress);

} // namespace parity::sweep
