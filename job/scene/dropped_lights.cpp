#include "job/scene/dropped_lights.h"

#include <algorithm>
#include <cassert>
#include <set>

#include "compare/metrics/measure_swaps.h"
#include "job/view/material_swaps.h"
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

// Mean FLIP against the reference's picture of those in which each of the materials that has pixels lacks the light
// alone.
std::vector<report::LightEffect> effectsOn(Context& context, const std::set<std::size_t>& materials,
                                           const scenes::Scene& scene, const ViewFrames& frames,
                                           const Displayed& reference, const base::Image& without, float exposureEv) {
  const Displayed shown = displayImage(without, context.display(), exposureEv);
  std::vector<compare::Swap> swaps;
  for (const std::size_t m : materials) {
    const base::PixelList& list = frames.coverage[m];
    compare::Swap& swap = swaps.emplace_back(
        displaySwap(context, list, mixByCoverage(list, frames.first().frame.color, without), 0, exposureEv, &shown));
    swap.linear = {};
    // What is no number in both is not the light's doing: black in both.
    std::erase_if(swap.nonFinite, [&](std::uint32_t place) {
      return std::ranges::binary_search(reference.nonFinite, list.pixels[place]);
    });
  }
  compare::MeasureRequest request;
  request.statistics = {"flip.mean"};
  const std::vector<compare::Figures> measured =
      compare::measureSwaps({.displayed = reference.pixels}, swaps, request).figures;
  std::vector<report::LightEffect> effects;
  for (auto m = materials.begin(); const compare::Figures& figures : measured) {
    const std::string& name = scene.materials[*m++].name;
    if (const std::optional<double> flip = figures.find("flip.mean"); flip && figures.pixels > 0)
      effects.push_back({name, *flip});
  }
  return effects;
}

} // namespace

std::optional<report::DroppedLights> measureDroppedLights(Context& context, const PreparedScene& prepared,
                                                          SceneRenderer& renderer, const scenes::Camera& camera,
                                                          const ViewFrames& frames, const ComparedView& compared) {
  if (renderer.seenSamples().empty()) return std::nullopt;
  const Settings& settings = prepared.settings;
  const scenes::Scene& scene = prepared.scene;
  const paths::Path& path = *renderer.paths().chosen[compared.test];
  const std::vector<scenes::Light>& lights = lightOf(prepared, path).lights;
  const std::vector<paths::LightUse> uses = path.countLightUse(
      scene, lights, settings.options, samplesInQuestion(scene, compared.materials, renderer.seenSamples()));
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < uses.size(); ++i)
    if (!uses[i].droppedBy.empty()) order.push_back(i);
  if (order.empty()) return std::nullopt;
  std::ranges::stable_sort(order, std::greater<>(), [&](std::size_t i) { return uses[i].effect; });

  const std::vector<std::string> names = scenes::lightNames(lights);
  report::DroppedLights dropped{.lights = lights.size(), .measured = {}, .notMeasured = {}};
  for (const std::size_t i : order) {
    if (dropped.measured.size() >= static_cast<std::size_t>(settings.droppedLights)) {
      dropped.notMeasured.push_back(names[i]);
      continue;
    }
    // Its place among the first path's: the other has the same but for a sun of the environment, which it keeps.
    assert(i < prepared.lights.size() && prepared.lights[i].name == lights[i].name);
    const base::Image color = renderer.renderWithout(i, camera);
    const base::Stopwatch watch(&context.timings(), "dropped lights");
    std::set<std::size_t> materials;
    for (const std::uint32_t instance : uses[i].droppedBy) materials.insert(materialOf(scene, instance));
    dropped.measured.push_back(
        {.name = names[i],
         .kind = scenes::nameOf(lights[i].kind),
         .keptBy = uses[i].keptBy,
         .droppedBy = uses[i].droppedBy.size(),
         .materials = effectsOn(context, materials, scene, frames, compared.reference, color, settings.exposureEv)});
  }
  report::rankByEffect(dropped);
  return dropped;
}

} // namespace parity::job
