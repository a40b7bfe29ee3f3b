// Pictures of what is advised, and of where the error lies.
#pragma once

#include <vector>

#include "job/settings.h"
#include "scenes/scene.h"
#include "study/explain/explanation.h"

namespace parity::explain {

class SetRenderer;

// Sets `illustration` of each material. places: of `materials` in the scene. settings: without switches. errors: FLIP
// of each material's pixels by these.
void illustrate(SetRenderer& renderer, const scenes::Scene& scene, const job::Settings& settings,
                const std::vector<Switch>& switches, const std::vector<std::size_t>& places,
                const std::vector<std::vector<float>>& errors, std::vector<MaterialExplanation>& materials);

} // namespace parity::explain
