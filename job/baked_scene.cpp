#include "job/baked_scene.h"

#include "base/error.h"
#include "mobile/light_choice.h"

namespace parity::job {

bake::BakeLights bakeLightsOf(const PreparedScene& prepared) {
  return {prepared.lights, mobile::chooseSun(prepared.lights), prepared.panorama};
}

void requireFresh(const PreparedScene& prepared, const std::string& folder) {
  const std::string change =
      bake::describeChange(prepared.baked->hashes, bake::hashScene(prepared.scene, bakeLightsOf(prepared)));
  if (!change.empty()) throw base::fileError(folder, "", change + "; parity bake makes it anew");
}

void takeBaked(PreparedScene& prepared, std::shared_ptr<const bake::BakedLight> baked) {
  std::vector<scenes::Light> sun;
  if (const auto index = mobile::chooseSun(prepared.lights)) sun = {prepared.lights[*index]};
  prepared.mobileLights = sun;
  if (baked->localLights == bake::LocalLights::isStatic) prepared.lights = sun;
  prepared.environment.reset();
  prepared.mobileEnvironment.reset();
  prepared.baked = std::move(baked);
}

} // namespace parity::job
