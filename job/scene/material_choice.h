// The materials that --material names.
#pragma once

#include <string>
#include <vector>

#include "base/frame.h"
#include "scenes/scene.h"

namespace parity::job {

// What to say of a glob that no material of the scene matches: with the nearest name.
std::string describeUnmatched(const scenes::Scene& scene, const std::string& glob);
// Whether any of these globs matches a material of the scene; no globs: true.
bool hasAnyMaterial(const scenes::Scene& scene, const std::vector<std::string>& globs);

// Throws Error (exit 4) for a glob that no material of the scene matches.
void requireMaterials(const scenes::Scene& scene, const std::vector<std::string>& globs);

// Leaves of a picture what shows materials that match: the rest becomes `background`, and 0 in the terms. A pixel that
// shows others, too, keeps its colour by the share of those that match. coverage: a list per material of the scene. No
// globs: all.
void keepMaterials(base::Frame& frame, const scenes::Scene& scene, const std::vector<std::string>& globs,
                   const std::vector<base::PixelList>& coverage, const glm::vec3& background);

} // namespace parity::job
