#include "job/scene/dropped_lobes.h"

#include "job/scene/swap_effects.h"

namespace parity::job {

void measureDroppedLobes(Context& context, const PreparedScene& prepared, SceneRenderer& renderer,
                         const scenes::Camera& camera, const ViewFrames& frames, ComparedView& compared) {
  const Settings& settings = prepared.settings;
  if (settings.droppedLights == 0 || !renderer.paths().chosen.front()->hidesLobes()) return;
  const paths::Path& path = *renderer.paths().chosen[compared.test];
  for (const auto& [feature, name] : gpu::kLobeFeatures) {
    std::set<std::size_t> materials;
    for (const std::size_t m : compared.materials)
      if ((path.droppedLobes(prepared.scene.materials[m], settings.options) & feature) != 0 &&
          !frames.coverage[m].pixels.empty())
        materials.insert(m);
    if (materials.empty()) continue;
    const base::Image without = renderer.renderWithoutLobes(feature, camera);
    const base::Stopwatch watch(&context.timings(), "dropped lobes");
    const std::map<std::size_t, double> effects =
        swapEffects(context, materials, frames, compared.reference, without, settings.exposureEv);
    for (std::size_t i = 0; i < compared.materials.size(); ++i)
      if (const auto found = effects.find(compared.materials[i]); found != effects.end())
        compared.view.materials[i].droppedLobes.push_back({name, found->second});
  }
}

} // namespace parity::job
