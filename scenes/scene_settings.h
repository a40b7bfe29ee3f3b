// What is loaded of a scene, and what lights it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/knob/table.h"
#include "scenes/load_options.h"
#include "scenes/scene_light.h"
#include "scenes/view.h"

namespace parity::scenes {

// What of a scene is compared: itself, or each of its materials on a sphere (scenes/builtin/material_balls.h).
enum class Subject { scene, ball };

struct SceneSettings {
  LoadOptions load;
  Subject subject = Subject::scene;
  std::string environment; // a file or builtin:NAME; "": the scene's own, if it has one
  float environmentRotationDeg = 0;
  bool extractSun = true; // bright compact sources of the environment become lights
  std::optional<SunRequest> sun;
  LightScales lightScales;
  Falloff falloff = Falloff::khr; // of its point and spot lights that have no exponent
  Fog fog;
  std::string baked;                   // folder of its baked light; "": none
  std::vector<std::string> fullyRough; // globs over material names, which take the fully rough shortcut
};

const base::KnobTable<SceneSettings>& sceneKnobs();
// Of all but the name.
const base::KnobTable<ViewRequest>& viewKnobs();

// Throws Error (usage) for what does not go together.
void requireSense(const ViewRequest& view);

} // namespace parity::scenes
