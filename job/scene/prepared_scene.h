// A scene made ready for its paths: loaded, lit, flagged.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bake/baked_light.h"
#include "base/background.h"
#include "job/context.h"
#include "job/paths.h"
#include "job/scene/passes.h"
#include "job/scene_request.h"
#include "scenes/scene.h"

namespace parity::job {

// The light is the same for all paths, but what one has in its environment another may have as a directional light
// (lighting/environment/sun_extraction.h). A path with one sun misses only that in its environment, and only where it
// is the brightest directional light of all.
struct PreparedScene {
  scenes::Scene scene;                             // fully-rough flags, fog and scales of light as requested
  std::vector<scenes::Light> lights;               // the scene's, --sun and what was extracted
  std::map<std::string, paths::Light> lightOfPath; // by name, of the paths asked for
  // Unfiltered, times the sky light's colour, to go with `lights`; kept for the truth and for baking alone.
  std::optional<scenes::Environment> panorama;
  // Takes the place of all lights but the sun, and its captures that of the environments (job/scene/baked_scene.h).
  // Null: none.
  std::shared_ptr<const bake::BakedLight> baked;
  Settings settings;                    // by which it is rendered
  bool isLit = true;                    // some object's material is not unlit: light is needed at all
  Work work;                            // done so far
  std::string environmentName, sunText; // for the report: the file without its folder; "none" where there is none

  // What finishLight takes: the environments of lightOfPath by the path's name, if they are being prepared, and the
  // scene's file, if its light is still to be looked at.
  base::Background<std::map<std::string, std::shared_ptr<const lighting::EnvironmentLight>>> pendingEnvironments;
  std::string pendingFile;
};

// A path's light; without lights and environment where the path was not asked for.
const paths::Light& lightOf(const PreparedScene& prepared, const paths::Path& path);

// Whether light passes through a material of the scene, so that the truth looks at what lies behind.
bool letsLightThrough(const scenes::Scene& scene);
// Whether the truth traces rays against the scene: for shadows, bounces, or what lies behind.
bool tracesScene(const PreparedScene& prepared);

// Loads scene and environment (at the same time), extracts suns, applies flags. Throws Error: exit 4 for what cannot
// be read, for an empty scene and for one with nothing that gives light; usage for a glob that no material matches.
PreparedScene prepareScene(Context& context, const SceneRequest& request, const PathChoice& paths);

// The same in two steps. Between them another thread prepares the environments of lightOfPath, and they are missing;
// the context must outlive that. With one thread finishLight itself prepares them.
PreparedScene beginScene(Context& context, const SceneRequest& request, const PathChoice& paths);
// Whether no other thread is at work for it.
bool isLightReady(const PreparedScene& prepared);
// Waits for the environments. Throws Error (exit 4) for a scene with nothing that gives light.
void finishLight(PreparedScene& prepared);

// For SceneRenderer's onLastRead: frees the pixels of an image. Empty where the truth will read them, where it
// tracesScene. `prepared` must outlive it.
std::function<void(int)> imageRelease(PreparedScene& prepared, const PathChoice& paths);

} // namespace parity::job
