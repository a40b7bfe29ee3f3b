#include "job/scene/baked_scene.h"

#include <algorithm>

#include <fmt/format.h>

#include "base/error.h"
#include "scenes/brightest_light.h"

namespace parity::job {

bake::BakeLights bakeLightsOf(const PreparedScene& prepared) {
  return {prepared.lights, scenes::brightestOf(prepared.lights, scenes::LightKind::directional), prepared.panorama};
}

void requireFresh(const PreparedScene& prepared, const std::string& folder) {
  const std::string change =
      bake::describeChange(prepared.baked->hashes, bake::hashScene(prepared.scene, bakeLightsOf(prepared)));
  if (!change.empty()) {
    const bool isAnother = prepared.baked->scene != prepared.scene.name;
    throw base::fileError(folder, "",
                          fmt::format("{}; run parity bake again{}", change,
                                      isAnother ? fmt::format(" (this bake is of '{}', the scene is '{}')",
                                                              prepared.baked->scene, prepared.scene.name)
                                                : ""));
  }
  const scenes::LightmapUvs& uvs = prepared.baked->uvs;
  bool fits = uvs.places.size() == prepared.scene.instances.size();
  for (std::size_t i = 0; fits && i < uvs.places.size(); ++i)
    fits = uvs.places[i].page < 0 || // it has no lightmap
           uvs.places[i].firstCorner + prepared.scene.meshes[prepared.scene.instances[i].mesh].indices.size() <=
               uvs.corners.size();
  if (!fits) throw base::fileError(folder, "", "does not have the objects of this scene; run parity bake again");
}

void takeBaked(PreparedScene& prepared, const PathChoice& paths, std::shared_ptr<const bake::BakedLight> baked) {
  // It comes first: the high-end path's mask is of its first directional light.
  const auto sun = scenes::brightestOf(prepared.lights, scenes::LightKind::directional);
  if (sun) std::rotate(prepared.lights.begin(), prepared.lights.begin() + *sun, prepared.lights.begin() + *sun + 1);
  const std::vector<scenes::Light> sunAlone(prepared.lights.begin(), prepared.lights.begin() + (sun ? 1 : 0));
  if (baked->localLights == bake::LocalLights::isStatic) prepared.lights = sunAlone;
  for (const paths::Path* path : paths.chosen) {
    paths::Light& light = prepared.lightOfPath[path->name()];
    light.lights = path->lightNeeds(prepared.settings.options).bakesLocalLights ? sunAlone : prepared.lights;
    if (!baked->captures.empty()) light.environment.reset();
  }
  if (!baked->captures.empty())
    prepared.scene.lightScales.skyLightColor = glm::vec3(1); // what the captures show has that colour
  prepared.baked = std::move(baked);
}

} // namespace parity::job
