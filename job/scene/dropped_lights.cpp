#include "job/scene/dropped_lights.h"

#include <algorithm>
#include <cassert>
#include <functional>
#include <map>
#include <set>

#include "job/scene/swap_effects.h"
#include "scenes/light_names.h"

namespace parity::job {

namespace {

std::size_t materialOf(const scenes::Scene& scene, std::size_t instance) {
  return scene.meshes[scene.instances[instance].mesh].material;
}

// Samples of the objects that may lack a light: an unlit one does not, and of others the report says nothing.
std::vector<std::uint64_t> samplesInQuestion(const scenes::Scene& scene, const std::vector<std::size_t>& materials,
                                             std::vector<std::uint64_t> samples) {
  for (std::size_t i = 0; i < samples.size(); ++i)
    if (const std::size_t m = materialOf(scene, i);
        scene.materials[m].unlit || std::ranges::find(materials, m) == materials.end())
      samples[i] = 0;
  return samples;
}

std::vector<report::LightEffect> named(const std::map<std::size_t, double>& effects, const scenes::Scene& scene) {
  std::vector<report::LightEffect> result;
  for (const auto& [material, flip] : effects) result.push_back({scene.materials[material].name, flip});
  return result;
}

} // namespace

std::optional<DroppedChoice> chooseDroppedLights(const PreparedScene& prepared, const SceneRenderer& renderer,
                                                 std::size_t test, const std::vector<std::size_t>& materials) {
  if (renderer.seenSamples().empty()) return std::nullopt;
  const paths::Path& path = *renderer.paths().chosen[test];
  DroppedChoice choice;
  choice.uses = path.countLightUse(prepared.scene, lightOf(prepared, path).lights, prepared.settings.options,
                                   samplesInQuestion(prepared.scene, materials, renderer.seenSamples()));
  for (std::size_t i = 0; i < choice.uses.size(); ++i)
    if (!choice.uses[i].droppedBy.empty()) choice.order.push_back(i);
  if (choice.order.empty()) return std::nullopt;
  std::ranges::stable_sort(choice.order, std::greater<>(), [&](std::size_t i) { return choice.uses[i].effect; });
  choice.measured = std::min(choice.order.size(), static_cast<std::size_t>(prepared.settings.droppedLights));
  return choice;
}

report::DroppedLights measureDroppedLights(Context& context, const PreparedScene& prepared, SceneRenderer& renderer,
                                           const scenes::Camera& camera, const ViewFrames& frames,
                                           const ComparedView& compared, DroppedChoice choice) {
  const scenes::Scene& scene = prepared.scene;
  const std::vector<scenes::Light>& lights = lightOf(prepared, *renderer.paths().chosen[compared.test]).lights;
  const std::vector<paths::LightUse>& uses = choice.uses;
  std::vector<std::size_t>& order = choice.order;
  const std::vector<std::string> names = scenes::lightNames(lights);
  report::DroppedLights dropped{.lights = lights.size(), .measured = {}, .notMeasured = {}};
  for (std::size_t i = choice.measured; i < order.size(); ++i) dropped.notMeasured.push_back(names[order[i]]);
  order.resize(choice.measured);
  // Their places among the first path's: the other has the same but for a sun of the environment, which it keeps.
  for ([[maybe_unused]] const std::size_t i : order)
    assert(i < prepared.lights.size() && prepared.lights[i].name == lights[i].name);
  renderer.renderWithout(order, camera, [&](std::size_t place, const base::Image& color) {
    const base::Stopwatch watch(&context.timings(), "dropped lights");
    const std::size_t i = order[place];
    std::set<std::size_t> materials;
    for (const std::uint32_t instance : uses[i].droppedBy) materials.insert(materialOf(scene, instance));
    dropped.measured.push_back(
        {.name = names[i],
         .kind = scenes::nameOf(lights[i].kind),
         .keptBy = uses[i].keptBy,
         .droppedBy = uses[i].droppedBy.size(),
         .materials = named(
             swapEffects(context, materials, frames, compared.reference, color, prepared.settings.exposureEv), scene)});
  });
  report::rankByEffect(dropped);
  return dropped;
}

} // namespace parity::job
