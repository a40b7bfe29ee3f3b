// Why figures changed: what of a run and of a scene's inputs is not as before. Figures have no noise, so this is no
// statistics: where nothing differs, the change itself is the fault.
#pragma once

#include <string>

#include "report/report.h"

namespace parity::history {

// What made a run, besides the inputs of its scenes.
struct Makers {
  std::string build, device, driver, numerics, settings, budgets, machine;
};

// Names of what differs and decides figures, joined by ",": of asset, environment, request, bake, pictures, build,
// device, driver, numerics, settings. Empty: nothing that is known. An input that is empty on one side counts as
// different.
std::string causesOf(const Makers& beforeRun, const report::SceneInputs& before, const Makers& nowRun,
                     const report::SceneInputs& now);

// Why a verdict changed though no figure did: "budgets", or "judging" (baseline, approvals or the date).
std::string judgingCause(const Makers& before, const Makers& now);

} // namespace parity::history
