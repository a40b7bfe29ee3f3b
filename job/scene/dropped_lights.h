// What the lights that a path drops do: the first path's picture with and without each.
#pragma once

#include <optional>

#include "job/scene/prepared_scene.h"
#include "job/scene/scene_renderer.h"
#include "job/view/view_comparison.h"
#include "report/dropped_lights.h"

namespace parity::job {

// Of the view that was rendered last, by this camera, and compared. Lights count as dropped by what objects of the
// report's materials do without (paths::LightUse); settings.droppedLights of them, those of the most estimated
// effect, are measured. A light goes from the whole picture, also where the path keeps it, but only materials of
// objects that drop it are measured. Nothing where none is dropped.
std::optional<report::DroppedLights> measureDroppedLights(Context& context, const PreparedScene& prepared,
                                                          SceneRenderer& renderer, const scenes::Camera& camera,
                                                          const ViewFrames& frames, const ComparedView& compared);

} // namespace parity::job
