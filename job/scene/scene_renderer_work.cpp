// What a scene's renderer has done, left out and compiled, in words and figures.
#include "job/scene/permutation_costs.h"
#include "job/scene/scene_renderer.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

namespace parity::job {

namespace {

std::uint64_t samplesOf(const gpu::ShadingPass& pass) {
  std::uint64_t samples = 0;
  for (const gpu::CompiledPermutation& each : pass.compiled()) samples += each.entries;
  return samples;
}

} // namespace

std::vector<std::string> SceneRenderer::notes() const {
  std::vector<std::string> notes;
  for (const PathState& each : m_paths)
    for (const std::string& note : each.plain->notes()) notes.push_back(each.path->name() + ": " + note);
  return notes;
}

std::vector<std::string> SceneRenderer::warnings() const {
  std::vector<std::string> warnings;
  if (m_cutPixels > 0)
    warnings.push_back(
        fmt::format("{} pixels show more than {} layers of blended surfaces; the farthest layers are ignored",
                    m_cutPixels, gpu::kMaxBlendedLayers));
  for (const PathState& each : m_paths)
    for (const std::string& warning : each.plain->warnings()) warnings.push_back(warning);
  if (m_truth && m_settings.reference.bounces > 0)
    warnings.emplace_back("the truth has light between surfaces, which no path has, and shadows of all light");
  else if (m_truth && m_settings.shadows && m_prepared.panorama)
    warnings.emplace_back("the environment casts shadows in the truth; shadow maps exist only for lights");
  return warnings;
}

std::vector<report::PermutationResult> SceneRenderer::permutations() const {
  std::vector<report::PermutationResult> all;
  for (const PathState& each : m_paths)
    for (report::PermutationResult& result : describePermutations(m_context, each.path->name(), *each.plain))
      all.push_back(std::move(result));
  return all;
}

Work SceneRenderer::work() const {
  Work work = m_work;
  const gpu::Textures& textures = m_scene.buffers().textures();
  work.images = textures.uploadedCount();
  work.varianceImages = textures.varianceCount();
  work.compressedImages = m_scene.compressedImages();
  std::set<std::uint32_t> placed;
  for (const scenes::Instance& instance : m_prepared.scene.instances)
    placed.insert(m_prepared.scene.meshes[instance.mesh].material);
  for (const std::uint32_t material : placed) {
    const std::uint32_t lobes = gpu::lobesOf(m_prepared.scene.materials[material]);
    for (std::size_t i = 0; i < work.lobes.size(); ++i) work.lobes[i] += (lobes & gpu::kLobeFeatures[i].feature) != 0;
  }
  std::set<const gpu::ShadowMaps*> maps;
  for (const PathState& each : m_paths) {
    std::uint64_t& samples = work.shadedSamples.emplace_back(each.path->name(), 0).second;
    for (const auto* renderer :
         {&each.plain, &each.ofOriginals, &each.withoutOne, &each.withoutSome, &each.lightsAlone})
      if (*renderer) {
        samples += samplesOf((*renderer)->pass());
        work.lightLists += (*renderer)->work().lightLists;
      }
    for (const auto& [features, renderer] : each.without) {
      samples += samplesOf(renderer->pass());
      work.lightLists += renderer->work().lightLists;
    }
    const paths::RendererWork own = each.plain->work();
    work.directionalLights += own.directionalLights;
    work.localLights += own.localLights;
    work.lightChoices += own.lightChoices;
    work.brdfTables = std::max(work.brdfTables, own.brdfTables);
    if (const gpu::ShadowMaps* shadows = each.plain->shadowMaps(); shadows && maps.insert(shadows).second) {
      work.shadowMaps += shadows->mapCount();
      work.shadowCasters += shadows->drawCount();
    }
  }
  return work;
}

Work SceneRenderer::workWithTerms() const {
  Work work = this->work();
  work.surfaceSamples += m_again.surfaceSamples;
  work.blendedSamples += m_again.blendedSamples;
  work.fogSamples += m_again.fogSamples;
  work.termSamples += m_again.termSamples;
  for (std::size_t i = 0; i < m_paths.size(); ++i) {
    if (!m_paths[i].withTerms) continue;
    work.shadedSamples[i].second += samplesOf(m_paths[i].withTerms->pass());
    work.lightLists += m_paths[i].withTerms->work().lightLists;
    work.lightChoices += m_paths[i].withTerms->work().lightChoices;
  }
  return work;
}

NoNeed SceneRenderer::reasons() const {
  const Settings& settings = m_settings;
  const std::string none = m_prepared.environmentName == "none" ? "no environment" : "",
                    unlit = m_prepared.isLit ? "" : "all objects are unlit";
  NoNeed why;
  why.environment = !none.empty() ? none : unlit;
  why.suns = !why.environment.empty() ? why.environment : "switched off";
  why.table = !unlit.empty()              ? unlit
              : m_prepared.lights.empty() ? "no environment and no lights"
                                          : "no environment, no compensation, no balanced diffuse lobe";
  why.texture = "no visible material has one";
  why.variance = settings.specularAa == gpu::SpecularAa::off ? "not requested" : "no normal map is visible";
  const bool compresses = std::ranges::any_of(m_choice.chosen, [&](const paths::Path* path) {
    return path->textureBlock(settings.options) != base::TextureBlock::none;
  });
  why.compression = compresses ? why.texture : "not requested";
  why.blended = "no blended material";
  why.backdrop = "light passes through no surface, or no path reads what is behind";
  why.fog = "no fog";
  why.lobe = "no object has it";
  why.directional = !unlit.empty() ? unlit : "no directional light";
  why.local = !unlit.empty() ? unlit : "no local lights";
  why.lightLists = work().localLights == 0 ? why.local : "few lights, or lights without a range";
  const bool asksForShadows = settings.shadows || std::ranges::any_of(m_choice.chosen, [&](const paths::Path* path) {
                                return path->asksForShadows(settings.options);
                              });
  why.shadows = !asksForShadows             ? "not requested"
                : !unlit.empty()            ? unlit
                : m_prepared.lights.empty() ? "no lights"
                                            : "no object can cast a shadow";
  why.baked = why.captures = m_prepared.baked ? "the bake has none" : "no baked light";
  if (m_prepared.baked && why.environment.empty()) why.environment = "the captures replace it";
  if (m_prepared.baked && why.local == "no local lights" && !m_prepared.scene.lights.empty())
    why.local = "they are baked";
  const bool allTakeAll =
      std::ranges::all_of(m_paths, [](const PathState& each) { return each.plain->work().localLights > 0; });
  why.lightChoice = work().localLights == 0 ? why.local
                    : allTakeAll            ? "every path takes all of them"
                                            : "the preset expects them baked";
  why.droppedLights = settings.droppedLights > 0 ? "no light of a visible object is dropped" : "not requested";
  why.droppedLobes = settings.droppedLights > 0 ? "no lobe of a visible material is dropped" : "not requested";
  why.terms = why.occluders = why.costs = why.whatIfs = "not requested";
  why.truth = settings.truth ? why.environment : "not requested";
  return why;
}

} // namespace parity::job
