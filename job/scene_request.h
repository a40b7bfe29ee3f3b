// Which scene to compare, and how.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/knob/knob.h"
#include "job/settings.h"
#include "scenes/suite/suite.h"
#include "scenes/view.h"

namespace parity::job {

// Where a scene stands in the run of which --only has left a part. Its shaders are specialised as in the whole run, so
// that its figures are the same.
struct WholeRun {
  std::size_t place = 0, scenes = 1; // of how many
  std::size_t views = 1;             // that the scene has there
};

struct SceneRequest {
  std::string name, scene; // in the report; file or builtin:NAME
  Settings settings;
  std::vector<glm::vec3> captures; // where `parity bake` puts environment captures; none: it finds places
  std::vector<scenes::ViewRequest> views;
  std::optional<std::string> budgets;  // path of a budget file for this scene
  std::vector<std::string> tags = {};  // of the suite
  std::optional<WholeRun> partOf = {}; // none: the run is whole
  base::GivenKnobs given = {};         // what its settings were made of: withKnobs
  std::vector<scenes::ExternalPictures> externals = {};
};

} // namespace parity::job
