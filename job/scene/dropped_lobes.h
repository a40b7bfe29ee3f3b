// What the lobes that a path drops are worth: the first path's picture with and without each.
#pragma once

#include "job/scene/prepared_scene.h"
#include "job/scene/scene_renderer.h"
#include "job/view/view_comparison.h"

namespace parity::job {

// Fills MaterialResult::droppedLobes of the view that was rendered last, by this camera, and compared: of each of the
// report's materials the lobes that the test path leaves out (paths::Path::droppedLobes), measured by the first path's
// picture with the material's lobe and without it. Nothing where the run measures no dropped lights
// (settings.droppedLights) or the first path cannot hide lobes.
void measureDroppedLobes(Context& context, const PreparedScene& prepared, SceneRenderer& renderer,
                         const scenes::Camera& camera, const ViewFrames& frames, ComparedView& compared);

} // namespace parity::job
