#include "sweep/live_variant.h"

#include "highend/env_brdf_lut.h"
#include "job/environment_upload.h"
#include "job/permutation_costs.h"
#include "job/texture_codec.h"

namespace parity::sweep {

namespace {

bool isDefault(const lighting::PrefilterOptions& o) {
  const lighting::PrefilterOptions plain = lighting::kFinePrefilter;
  return o.sampleCount == plain.sampleCount && o.faceSize == plain.faceSize;
}

} // namespace

const gpu::EnvironmentMaps* Shared::highendEnvironment(const lighting::PrefilterOptions& options) {
  if (!m_prepared.environment) return nullptr;
  const std::pair key(options.sampleCount, options.faceSize);
  if (const auto found = m_highend.find(key); found != m_highend.end()) return &found->second;
  const gpu::Device& device = m_context.device();
  gpu::EnvironmentMaps maps =
      isDefault(options) ? job::uploadEnvironment(device, *m_prepared.environment, m_prepared.cells.get())
                         : job::uploadEnvironment(device, lighting::makeEnvironmentLight(*m_prepared.panorama, options),
                                                  m_prepared.cells.get());
  return &m_highend.emplace(key, std::move(maps)).first->second;
}

const gpu::EnvironmentMaps* Shared::mobileEnvironment(mobile::CaptureEncoding encoding) {
  if (!m_prepared.mobileEnvironment) return nullptr;
  const auto found = m_mobile.find(encoding);
  if (found != m_mobile.end()) return &found->second;
  return &m_mobile.emplace(encoding, job::uploadCapture(m_context.device(), *m_prepared.mobileEnvironment, encoding))
              .first->second;
}

const base::Image& Shared::lut(const highend::Options& o, int size) {
  const std::tuple key(o.geometryTerm, o.fresnel, size);
  const auto found = m_luts.find(key);
  if (found != m_luts.end()) return found->second;
  return m_luts.emplace(key, highend::makeEnvBrdfLut(o.geometryTerm, o.fresnel, size)).first->second;
}

gpu::ShadowMaps* Shared::highendShadows(const gpu::SceneBuffers& buffers) {
  if (!m_prepared.shadows) return nullptr;
  if (!m_highendShadows)
    m_highendShadows.emplace(m_context.device(), buffers, m_prepared.lights, m_context.settings().shadowMaps);
  return &*m_highendShadows;
}

gpu::ShadowMaps* Shared::mobileShadows(const gpu::SceneBuffers& buffers, const mobile::Options& options) {
  const auto casting = mobile::Renderer::needsShadowMaps(m_prepared.mobileLights, options);
  if (casting.empty()) return nullptr;
  std::vector<gpu::ShadowKey> key;
  for (const scenes::Light& light : casting) key.push_back(gpu::shadowKey(light));
  return &m_mobileShadows.try_emplace(key, m_context.device(), buffers, casting, m_context.settings().shadowMaps)
              .first->second;
}

const gpu::Textures* Shared::mobileTextures(const Surfaces& surfaces, base::TextureBlock block) {
  if (block == base::TextureBlock::none) return nullptr;
  std::unique_ptr<const gpu::Textures>& textures = m_textures[block];
  if (textures) return textures.get();
  textures = std::make_unique<const gpu::Textures>(m_context.device(), m_prepared.scene,
                                                   m_context.settings().specularAa == gpu::SpecularAa::toksvig,
                                                   gpu::ImageDone(), job::makeTextureCodec(m_context, block));
  for (const Surfaces::Part& part : surfaces.parts())
    for (const gpu::Surface& layer : part.layers) textures->require(gpu::texturesOf(layer.bins, surfaces.binKinds()));
  return textures.get();
}

void Shared::prepareAgain(const Variant& v) const {
  if (v.knob == "lut-size")
    highend::makeEnvBrdfLut(v.highend.geometryTerm, v.highend.fresnel, v.lutSize);
  else
    lighting::makeEnvironmentLight(*m_prepared.panorama, v.prefilter);
}

LiveVariant::LiveVariant(const Variant& variant, const Surfaces& surfaces, Shared& shared)
    : m_variant(variant), m_surfaces(surfaces), m_shared(shared) {
  const gpu::Device& device = shared.context().device();
  const job::PreparedScene& prepared = shared.prepared();
  // As many as if it were shaded often: each setting gets the permutations that suit it.
  constexpr std::uint64_t kMany = std::uint64_t{1} << 40;
  if (variant.path == "highend") {
    highend::Inputs inputs{.environment = shared.highendEnvironment(variant.prefilter),
                           .lut = nullptr,
                           .lights = prepared.lights,
                           .shadows = shared.highendShadows(surfaces.buffers()),
                           .terms = false,
                           .expectedPixels = kMany};
    if (highend::Renderer::needsLut(inputs, variant.highend))
      inputs.lut = &shared.lut(variant.highend, variant.lutSize);
    m_highend.emplace(device, surfaces.buffers(), surfaces.binKinds(), inputs, variant.highend);
  } else {
    const mobile::Inputs inputs{.environment = shared.mobileEnvironment(variant.mobile.capture),
                                .lights = prepared.mobileLights,
                                .shadows = shared.mobileShadows(surfaces.buffers(), variant.mobile),
                                .textures = shared.mobileTextures(surfaces, variant.textures),
                                .terms = false,
                                .view = mobile::kViewLit,
                                .expectedPixels = kMany};
    m_mobile.emplace(device, surfaces.buffers(), surfaces.binKinds(), inputs, variant.mobile);
  }
}

base::Image LiveVariant::compose(const std::vector<Surfaces::Shaded>& shaded) const {
  std::optional<gpu::TargetCodec> target;
  if (m_mobile)
    target.emplace(m_variant.target, m_shared.prepared().exposureEv,
                   mobile::precisionOn(m_shared.context().device().report(), m_variant.mobile) ==
                       mobile::Precision::fp16);
  return m_surfaces.compose(shaded, target);
}

compare::PathCost LiveVariant::cost() const {
  const auto described = [&](const auto& renderer) {
    return job::describePermutations(
        m_shared.context(), m_variant.path, renderer.pass(),
        [&](const gpu::Permutation& permutation) { return renderer.countSamplers(permutation); });
  };
  const auto costs = compare::costsByPath(m_highend ? described(*m_highend) : described(*m_mobile));
  return costs.empty() ? compare::PathCost{} : costs.front();
}

} // namespace parity::sweep
