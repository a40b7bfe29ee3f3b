// Changes of the asset that would bring a material within its limit: suggestions, which nothing applies.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "job/settings.h"
#include "scenes/scene.h"
#include "study/explain/explanation.h"

namespace parity::explain {

// Changes that are tried, the smallest first: roughness, metallic and base colour by 5, 10, 20 and 25 %. value and flip
// are left out.
std::vector<AssetChange> assetChanges();

// The material with this change; nothing where it has none of the quantity, where a value would rise above 1, or where
// the shaders would take it for another class of material. `change.value` is set.
std::optional<scenes::Material> withChange(const scenes::Material& material, AssetChange& change);

// "roughness 0.27 instead of 0.3", "roughness times 0.9".
std::string describe(const AssetChange& change);

class SetRenderer;

// Sets `asset` of those over their limits that a change brings within. All are changed at once to see which change may
// do, then each alone, by specialised programs. places: of `materials` in the scene. tell: is given the share of the
// work that is done.
void suggestAssets(SetRenderer& renderer, const job::Settings& settings, const scenes::Scene& scene,
                   const std::vector<std::size_t>& places, std::vector<MaterialExplanation>& materials,
                   const std::function<void(double)>& tell);

} // namespace parity::explain
