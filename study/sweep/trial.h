// One scene by every setting, over the very same surface buffer: times, costs and errors.
#pragma once

#include "job/scene_request.h"
#include "job/settings.h"
#include "study/sweep/sweep_report.h"
#include "study/sweep/trial_options.h"

namespace parity::job {
class Context;
}

namespace parity::sweep {

// Shades every setting in random order, round after round, so that drift falls on all alike. Errors are of what the
// screen shows (FLIP) and of exposed light (relMSE), over the pixels that the scene covers and by material. context:
// its settings say size, view, device and the defaults of both paths; with `costs` shaders are counted. Throws Error as
// job::prepareScene does. A glob that matches nothing here stands among what is skipped.
SceneSweep runTrial(job::Context& context, const job::SceneRequest& request, const TrialOptions& options,
                    const job::Progress& progress);

} // namespace parity::sweep
