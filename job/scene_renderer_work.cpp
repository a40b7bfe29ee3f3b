// What a scene's renderer has done, left out and compiled, in words and figures.
#include "job/permutation_costs.h"
#include "job/scene_renderer.h"

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
  if (!m_mobile) return {};
  std::vector<std::string> notes = m_mobile->notes();
  if (m_mobileShadowMaps && !m_mobileShadowMaps->note().empty()) notes.push_back(m_mobileShadowMaps->note());
  if (m_prepared.shadows)
    notes.emplace_back(
        m_mobileShadowMaps
            ? "has its other shadows baked, and nothing is baked: only high-end casts those of all lights"
            : "has its shadows baked, and nothing is baked: only high-end casts them");
  return notes;
}

std::vector<std::string> SceneRenderer::warnings() const {
  std::vector<std::string> warnings;
  if (m_cutPixels > 0)
    warnings.push_back(
        fmt::format("{} pixels show more than {} blended surfaces behind one another: the farthest are left out",
                    m_cutPixels, gpu::kMaxBlendedLayers));
  if (m_shadowMaps && !m_shadowMaps->note().empty()) warnings.push_back(m_shadowMaps->note());
  if (m_reference && m_prepared.bounces > 0)
    warnings.emplace_back("the truth has light between surfaces and shadows of all light: neither path has the former");
  else if (m_reference && m_prepared.shadows && m_prepared.panorama)
    warnings.emplace_back("the truth shadows the environment's light, too: high-end's maps are of lights alone");
  return warnings;
}

std::vector<compare::PermutationResult> SceneRenderer::permutations() const {
  std::vector<compare::PermutationResult> all;
  const auto append = [&](const char* path, const auto& renderer) {
    const auto described = describePermutations(
        m_context, path, renderer.pass(), [&](const gpu::Permutation& each) { return renderer.countSamplers(each); });
    all.insert(all.end(), described.begin(), described.end());
  };
  if (m_highend) append("highend", *m_highend);
  if (m_mobile) append("mobile", *m_mobile);
  return all;
}

Work SceneRenderer::work() const {
  Work work = m_work;
  work.images = m_buffers.textures().uploadedCount();
  work.varianceImages = m_buffers.textures().varianceCount();
  if (m_mobileTextures) work.compressedImages = m_mobileTextures->uploadedCount();
  for (const highend::Renderer* renderer : {m_highend.get(), m_highendSwitched.get()})
    if (renderer) {
      work.highendSamples += samplesOf(renderer->pass());
      work.lightLists += renderer->lightLists();
    }
  for (const mobile::Renderer* renderer : {m_mobile.get(), m_mobileOfOriginals.get()})
    if (renderer) work.mobileSamples += samplesOf(renderer->pass());
  if (m_highend) {
    work.directionalLights = m_highend->pass().directionalCount();
    work.localLights = m_highend->pass().localCount();
  }
  for (const auto* maps : {&m_shadowMaps, &m_mobileShadowMaps})
    if (*maps) {
      work.shadowMaps += (*maps)->mapCount();
      work.shadowCasters += (*maps)->drawCount();
    }
  if (m_mobile) work.lightChoices = m_mobile->lightChoices();
  return work;
}

Work SceneRenderer::workWithTerms() const {
  Work work = this->work();
  if (!m_highendTerms) return work;
  work.surfaceSamples += m_again.surfaceSamples;
  work.blendedSamples += m_again.blendedSamples;
  work.fogSamples += m_again.fogSamples;
  work.termSamples += m_again.termSamples;
  work.highendSamples += samplesOf(m_highendTerms->pass());
  work.mobileSamples += samplesOf(m_mobileTerms->pass());
  work.lightLists += m_highendTerms->lightLists();
  work.lightChoices += m_mobileTerms->lightChoices();
  return work;
}

NoNeed SceneRenderer::reasons() const {
  const Settings& settings = m_context.settings();
  const std::string none = m_prepared.environmentName == "none" ? "no environment" : "",
                    unlit = m_prepared.isLit ? "" : "all that is placed is unlit";
  NoNeed why;
  why.environment = !none.empty() ? none : unlit;
  why.suns = !why.environment.empty() ? why.environment : "switched off";
  why.table = !unlit.empty()              ? unlit
              : m_prepared.lights.empty() ? "no environment and no lights"
                                          : "no environment, no compensation, no balance";
  why.texture = "no material that is seen has one";
  why.variance = settings.specularAa == gpu::SpecularAa::off ? "not asked for" : "no normal map is seen";
  why.compression = settings.mobileTextures == base::TextureBlock::none ? "not asked for" : why.texture;
  why.blended = "no blended material";
  why.fog = "no fog";
  why.directional = !unlit.empty() ? unlit : "no directional light";
  why.local = !unlit.empty() ? unlit : "no local lights";
  why.lightLists = work().localLights == 0 ? why.local : "few lights, or lights without a range";
  why.shadows = !m_prepared.shadows && !settings.mobile.spotShadow && !settings.mobile.sunShadow ? "not asked for"
                : !unlit.empty()                                                                 ? unlit
                : m_prepared.lights.empty()                                                      ? "no lights"
                                            : "nothing stands before anything";
  why.baked = why.captures = m_prepared.baked ? "the bake has none" : "nothing is baked";
  if (m_prepared.baked && why.environment.empty()) why.environment = "the captures take its place";
  if (m_prepared.baked && why.local == "no local lights" && !m_prepared.scene.lights.empty())
    why.local = "they are baked";
  why.lightChoice = work().localLights == 0 ? why.local : "the preset has them baked";
  why.droppedLights = settings.droppedLights > 0 ? "mobile has all lights that reach what is seen" : "not asked for";
  why.terms = why.occluders = why.costs = "not asked for";
  why.truth = settings.truth ? why.environment : "not asked for";
  return why;
}

} // namespace parity::job
