// A scene made ready for both paths: loaded, lit, flagged.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "job/context.h"
#include "scenes/scene.h"

namespace parity::job {

// What to load: a suite entry, or the command line's one scene in the same form.
using SceneRequest = scenes::SuiteEntry;

struct PreparedScene {
  scenes::Scene scene;               // environment and fully-rough flags as requested
  std::vector<scenes::Light> lights; // the scene's and the sun
  std::optional<lighting::EnvironmentLight> environment;
  std::optional<scenes::Environment> panorama; // unfiltered; kept for the reference alone
  std::string environmentName, sunText; // for the report: the file without its folder; "none" where there is none
};

// Which forms of the environment the paths of a run read.
struct EnvironmentForms {
  bool filtered = true;  // highend and mobile
  bool panorama = false; // the reference
};

// Loads scene and environment (at the same time), applies flags and sun. Throws Error: exit 4 for what cannot be read,
// for an empty scene and for one with nothing that gives light; usage for a glob that no material matches.
PreparedScene prepareScene(Context& context, const SceneRequest& request, const EnvironmentForms& forms = {});

} // namespace parity::job
