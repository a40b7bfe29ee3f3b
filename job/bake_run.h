// One bake: a scene in, its baked light out.
#pragma once

#include <functional>

#include "bake/atlas/atlas.h"
#include "bake/baked_light.h"
#include "bake/light/integrate.h"
#include "base/image/astc.h"
#include "job/context.h"
#include "job/scene_request.h"

namespace parity::job {

struct BakeOptions {
  bake::AtlasOptions atlas;         // texelsPerMetre 0: bake::defaultTexelsPerMetre
  bake::IntegrateOptions integrate; // texelsPerMetre: the atlas' is taken
  base::AstcBlock astc = base::AstcBlock::astc4x4;
  bake::LocalLights localLights = bake::LocalLights::isStatic;
  int captures = -1;     // where the request names no places; -1: by the scene's floor space, kMaxCaptures at most
  int captureSize = 128; // texels along a face, a power of two
};
inline constexpr int kMaxCaptures = 8;

// What was done, besides what the figures of the light say.
struct BakeResult {
  bake::BakedLight light;
  std::vector<std::string> notes; // how each mesh got its uvs; warnings of the scene
  std::uint64_t rays = 0;         // cast by this run, not those that the cache has spared
};

// Throws Error as prepareScene, makeAtlas and integrate do. The context's cache keeps what is done, so that a run after
// one that was cancelled goes on from there. progress: of the whole.
BakeResult bakeScene(Context& context, const SceneRequest& request, const BakeOptions& options,
                     const Progress& progress = {}, const std::function<bool()>& isCancelled = {});

} // namespace parity::job
