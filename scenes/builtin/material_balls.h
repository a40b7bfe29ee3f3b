// Every material of a scene on a sphere of its own.
#pragma once

#include "scenes/scene.h"

namespace parity::scenes {

// The materials of `scene` (also those that no mesh shows; loaded with LoadOptions::allMaterials) side by side, left to
// right and top to bottom in their order, each on a sphere of radius .46 m a metre apart, in the plane z = 0, seen
// along -Z by an orthographic default camera. The spheres' uv run twice around and once from pole to pole, in both
// sets. Environment and directional lights stay; point and spot lights, cameras and vertex colours belong to the
// scene's own geometry and are left out, with a line in `warnings`. Throws Error (exit 4) where there is no material,
// and beyond 10,000.
Scene makeMaterialBalls(Scene scene);

} // namespace parity::scenes
