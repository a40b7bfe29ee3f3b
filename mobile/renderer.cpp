#include "mobile/renderer.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "mobile/light_choice.h"
#include "mobile_shaders/mobile.comp.h"

namespace parity::mobile {

const std::vector<std::string>& presetNames() {
  static const std::vector<std::string> names = {"karis2014", "ue4-2020"};
  return names;
}

Preset presetByName(const std::string& name) {
  if (name == "karis2014") return Preset::karis2014;
  if (name == "ue4-2020") return Preset::ue4_2020;
  throw base::Error(base::ExitCode::usage, "--mobile-preset", name,
                    fmt::format("unknown; the presets are {}", fmt::join(presetNames(), ", ")));
}

Renderer::Renderer(const gpu::Device& device, const gpu::SceneBuffers& scene, const std::vector<gpu::BinKind>& binKinds,
                   const Inputs& inputs, Preset preset) {
  gpu::PathProgram program;
  program.name = "mobile";
  program.spirv = kMobileComp;

  // The sun comes first, the local lights keep their order; pathData holds indices into this list.
  std::vector<scenes::Light> lights;
  const auto sun = chooseSun(inputs.lights);
  if (sun) lights.push_back(inputs.lights[*sun]);
  const auto directional = std::count_if(inputs.lights.begin(), inputs.lights.end(),
                                         [](const auto& l) { return l.kind == scenes::LightKind::directional; });
  if (directional > 1)
    m_notes.push_back(fmt::format("{} of {} directional lights are left out: the path has one sun, the brightest",
                                  directional - 1, directional));
  for (const scenes::Light& light : inputs.lights)
    if (light.kind != scenes::LightKind::directional) lights.push_back(light);
  const std::size_t localCount = lights.size() - (sun ? 1 : 0);
  if (preset == Preset::karis2014) {
    if (localCount > 0)
      m_notes.push_back(fmt::format("{} local lights are left out: karis2014 has them baked", localCount));
    lights.resize(sun ? 1 : 0);
  } else if (localCount > 0) {
    std::set<std::uint32_t> used;
    for (const auto& slots : chooseLocalLights(scene.scene(), lights))
      for (const std::uint32_t index : slots) {
        program.pathData.push_back(index);
        if (index != kNoLight) used.insert(index);
      }
    program.localCount = static_cast<std::uint32_t>(used.size());
    if (localCount > kLightsPerObject)
      m_notes.push_back(
          fmt::format("of {} local lights each object gets the {} brightest", localCount, kLightsPerObject));
  }
  for (const scenes::Light& light : lights) program.lights.push_back(gpu::packLight(light));
  program.directionalCount = sun ? 1 : 0;
  program.environment = inputs.environment;
  program.constants = {preset == Preset::karis2014 ? gpu::kPresetKaris2014 : gpu::kPresetUe42020};
  program.terms = inputs.terms;
  program.premultiplied = true;
  program.expectedPixels = inputs.expectedPixels;
  m_pass = std::make_unique<gpu::ShadingPass>(device, scene, binKinds, std::move(program));
}

} // namespace parity::mobile
