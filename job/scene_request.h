// Which scene to compare, and how.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "job/settings.h"
#include "scenes/view.h"

namespace parity::job {

struct SceneRequest {
  std::string name, scene; // in the report; file or builtin:NAME
  Settings settings;
  std::vector<glm::vec3> captures; // where `parity bake` puts environment captures; none: it finds places
  std::vector<scenes::ViewRequest> views;
  std::optional<std::string> budgets; // path of a budget file for this scene
};

} // namespace parity::job
