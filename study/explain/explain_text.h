// Explanations as a terminal and as JSON have them.
#pragma once

#include <string>
#include <vector>

#include "study/explain/explanation.h"
#include "study/explain/team.h"

namespace parity::explain {

inline constexpr int kExplainFormat = 1; // of the JSON

// A table for each scene, worst materials first: today's FLIP, the best set of each size, what each switch is worth;
// below it the sentences. allSets: also materials within their limit with nothing to say of them.
std::string toText(const SceneExplanation& scene, bool allMaterials);
// "over 12 materials: ..."; empty for fewer than two.
std::string toText(const TeamView& team);

// Everything, with what was measured of every set (docs/explain.md).
std::string toJson(const std::vector<SceneExplanation>& scenes, const TeamView& team, const std::string& commandLine);

} // namespace parity::explain
