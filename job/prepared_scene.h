// A scene made ready for both paths: loaded, lit, flagged.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bake/baked_light.h"
#include "job/context.h"
#include "job/passes.h"
#include "job/scene_request.h"
#include "lighting/panorama_cells.h"
#include "scenes/scene.h"

namespace parity::job {

// Which paths to shade.
struct Paths {
  bool highend = true, mobile = true, reference = false;
  bool bakes = false; // the scene is to be baked: it keeps its panorama, which is not prefiltered
};

// The light is the same for all paths, but what one has in its environment another may have as a directional light
// (lighting/sun_extraction.h). Mobile has one sun: only if the brightest directional light of all was extracted, it is
// missing in mobile's environment.
struct PreparedScene {
  scenes::Scene scene;                             // fully-rough flags, fog and scales of light as requested
  std::vector<scenes::Light> lights, mobileLights; // the scene's, --sun and what was extracted
  // Prefiltered, for the paths asked for: fine levels for the high-end path, the first ones for mobile. None: no
  // environment.
  std::shared_ptr<const lighting::EnvironmentLight> environment, mobileEnvironment;
  std::shared_ptr<const lighting::PanoramaCells> cells; // to go with `environment`
  // Unfiltered, times the sky light's colour, to go with `lights`; kept for the reference and for baking alone.
  std::optional<scenes::Environment> panorama;
  // Takes the place of all lights but the sun, and its captures that of the environments (job/baked_scene.h). Null:
  // none.
  std::shared_ptr<const bake::BakedLight> baked;
  float exposureEv = 0;                 // of the camera
  bool shadows = false;                 // lights cast them
  int bounces = 0;                      // of light between its surfaces, in the reference
  bool isLit = true;                    // some object's material is not unlit: light is needed at all
  Work work;                            // done so far
  std::string environmentName, sunText; // for the report: the file without its folder; "none" where there is none
};

// Loads scene and environment (at the same time), extracts suns, applies flags. Throws Error: exit 4 for what cannot
// be read, for an empty scene and for one with nothing that gives light; usage for a glob that no material matches.
PreparedScene prepareScene(Context& context, const SceneRequest& request, const Paths& paths = {});

// For SceneRenderer's onLastRead: frees the pixels of an image. Empty where the reference will read them, to let light
// through masks or to reflect it. `prepared` must outlive it.
std::function<void(int)> imageRelease(PreparedScene& prepared, const Paths& paths);

} // namespace parity::job
