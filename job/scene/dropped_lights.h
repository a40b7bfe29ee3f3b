// What the lights that a path drops do: the first path's picture with and without each.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "job/scene/prepared_scene.h"
#include "job/scene/scene_renderer.h"
#include "job/view/view_comparison.h"
#include "paths/path.h"
#include "report/dropped_lights.h"

namespace parity::job {

// What objects of the report's materials do without in the view that was rendered last (paths::LightUse).
struct DroppedChoice {
  std::vector<paths::LightUse> uses; // of all lights of the path
  std::vector<std::size_t> order;    // the lights that are dropped, that of the most estimated effect first
  // How many of them are measured: settings.droppedLights at most.
  std::size_t measured = 0;
};

// test: the path's place among the renderer's. materials: those of the report, by their places in the scene. Nothing
// where none is dropped.
std::optional<DroppedChoice> chooseDroppedLights(const PreparedScene& prepared, const SceneRenderer& renderer,
                                                 std::size_t test, const std::vector<std::size_t>& materials);

// Of the view that was rendered last, by this camera, once it is compared. A light goes from the whole picture, also
// where the path keeps it, but only materials of objects that drop it are measured.
report::DroppedLights measureDroppedLights(Context& context, const PreparedScene& prepared, SceneRenderer& renderer,
                                           const scenes::Camera& camera, const ViewFrames& frames,
                                           const ComparedView& compared, DroppedChoice choice);

} // namespace parity::job
