#include "job/scene_renderer.h"

#include <cassert>

#include "base/parallel.h"
#include "job/environment_upload.h"
#include "job/permutation_costs.h"

namespace parity::job {

namespace {

std::uint64_t pixelsOf(const Settings& settings, std::size_t views) {
  return static_cast<std::uint64_t>(settings.width) * settings.height * settings.samples * views;
}

std::uint64_t samplesOf(const gpu::ShadingPass& pass) {
  std::uint64_t samples = 0;
  for (const gpu::CompiledPermutation& each : pass.compiled()) samples += each.entries;
  return samples;
}

} // namespace

SceneRenderer::SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views,
                             const gpu::PermutationBudget& budget)
    : m_context(context), m_prepared(prepared), m_budget(budget), m_work(prepared.work), m_buffers([&] {
        gpu::Device& device = context.device();
        const base::Stopwatch watch(&context.timings(), "upload");
        return gpu::SceneBuffers(device, prepared.scene, context.settings().specularAa);
      }()),
      m_surfacePass(context.device(), m_buffers, static_cast<std::uint32_t>(context.settings().width),
                    static_cast<std::uint32_t>(context.settings().height)) {
  const gpu::Device& device = context.device();
  if (prepared.environment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_environment = uploadEnvironment(device, *prepared.environment);
  }
  if (prepared.mobileEnvironment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_mobileEnvironment = uploadCapture(device, *prepared.mobileEnvironment, context.settings().mobile.capture);
  }
  if (paths.highend) m_highend = makeHighend(context.settings().terms, views);
  if (paths.mobile) m_mobile = makeMobile(context.settings().terms, views);
  if (paths.reference) {
    m_reference.emplace(context, prepared, m_buffers, m_surfacePass.binKinds(), pixelsOf(context.settings(), views),
                        gpu::Compilation{budget, &context.pipelines()});
    if (context.settings().referenceShadows) m_work.occluderMeshes = prepared.scene.meshes.size();
  }
}

std::unique_ptr<highend::Renderer> SceneRenderer::makeHighend(bool terms, std::size_t views) {
  const Settings& settings = m_context.settings();
  highend::Inputs inputs{.environment = m_environment ? &*m_environment : nullptr,
                         .lut = nullptr,
                         .lights = m_prepared.isLit ? m_prepared.lights : std::vector<scenes::Light>(),
                         .terms = terms,
                         .compilation = {m_budget, &m_context.pipelines()},
                         .expectedPixels = pixelsOf(settings, views)};
  if (highend::Renderer::needsLut(inputs, settings.highend)) {
    inputs.lut = &m_context.envBrdfLut();
    m_work.brdfTables = 1;
  }
  return std::make_unique<highend::Renderer>(m_context.device(), m_buffers, m_surfacePass.binKinds(), inputs,
                                             settings.highend);
}

std::unique_ptr<mobile::Renderer> SceneRenderer::makeMobile(bool terms, std::size_t views) const {
  const Settings& settings = m_context.settings();
  const mobile::Inputs inputs{.environment = m_mobileEnvironment ? &*m_mobileEnvironment : nullptr,
                              .lights = m_prepared.isLit ? m_prepared.mobileLights : std::vector<scenes::Light>(),
                              .terms = terms,
                              .view = settings.mobileView,
                              .compilation = {m_budget, &m_context.pipelines()},
                              .expectedPixels = pixelsOf(settings, views)};
  return std::make_unique<mobile::Renderer>(m_context.device(), m_buffers, m_surfacePass.binKinds(), inputs,
                                            settings.mobile);
}

SceneRenderer::Layers SceneRenderer::rasterise(const scenes::Camera& camera, const gpu::Tile& tile,
                                               const glm::vec2& sample) {
  const base::Stopwatch watch(&m_context.timings(), "surface");
  Layers layers{m_surfacePass.render(camera, tile, sample, gpu::Layer::opaque), {}};
  if (m_surfacePass.hasBlended()) layers.blended = m_surfacePass.render(camera, tile, sample, gpu::Layer::blended);
  return layers;
}

// And uploads what shading them will read, once for all paths.
void SceneRenderer::countSurfaces(const gpu::Surface& opaque, const gpu::Surface& blended) {
  m_work.surfaceSamples += opaque.size();
  m_work.blendedSamples += blended.size();
  const std::uint64_t samples = opaque.size() + blended.size();
  if ((m_buffers.vertexData() & gpu::kVertexFog) != 0) m_work.fogSamples += samples;
  const std::uint64_t paths = (m_highend ? 1 : 0) + (m_mobile ? 1 : 0) + (m_reference ? 1 : 0);
  if (m_context.settings().terms) m_work.termSamples += paths * samples;
  if (m_reference) m_work.resolvedSamples += samples;
  const base::Stopwatch watch(&m_context.timings(), "upload");
  for (const gpu::Surface* surface : {&opaque, &blended})
    m_buffers.textures().require(gpu::texturesOf(*surface, m_surfacePass.binKinds()));
}

ViewFrames SceneRenderer::render(const scenes::Camera& camera, const Progress& progress) {
  const Settings& settings = m_context.settings();
  const auto width = static_cast<std::uint32_t>(settings.width), height = static_cast<std::uint32_t>(settings.height);
  gpu::FrameBuilder highendFrame(width, height, settings.samples, settings.terms, settings.background);
  gpu::FrameBuilder referenceFrame = highendFrame;
  // An intermediate is looked at as it was computed.
  std::optional<gpu::TargetCodec> target;
  if (settings.mobileView == mobile::kViewLit)
    target.emplace(settings.mobileTarget, m_prepared.exposureEv,
                   mobile::precisionOn(m_context.device().report(), settings.mobile) == mobile::Precision::fp16);
  gpu::FrameBuilder mobileFrame(width, height, settings.samples, settings.terms, settings.background, target);
  gpu::FrameBuilder beforeTarget(width, height, settings.samples, false, settings.background);
  ErrorBuilder referenceError(m_reference ? settings.width : 0, m_reference ? settings.height : 0, settings.samples);
  std::uint64_t sampledPoints = 0, lightSamples = 0;
  gpu::CoverageBuilder coverage(m_buffers, settings.samples);
  m_kept.reset();
  const bool compared = m_highend && m_mobile; // masks are for comparing

  const std::vector<gpu::Tile> tiles = gpu::makeTiles(width, height);
  const double parts = static_cast<double>(tiles.size()) * settings.samples;
  double partsDone = 0;
  std::uint32_t stream = 0;
  for (const gpu::Tile& tile : tiles)
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples)) {
      Layers layers = rasterise(camera, tile, sample);
      const gpu::Surface &opaque = layers.opaque, &blended = layers.blended;
      countSurfaces(opaque, blended);
      const gpu::Surface* layer = m_surfacePass.hasBlended() ? &blended : nullptr;
      gpu::ShadedSurface shadedLayer;
      const auto shadeBy = [&](const auto& renderer, const char* stage,
                               std::initializer_list<gpu::FrameBuilder*> builders) {
        const base::Stopwatch watch(&m_context.timings(), stage);
        const gpu::ShadedSurface shaded = renderer.shade(opaque, camera);
        if (layer) shadedLayer = renderer.shade(blended, camera);
        for (gpu::FrameBuilder* builder : builders)
          if (builder) builder->add(opaque, shaded, layer, layer ? &shadedLayer : nullptr, tile);
      };
      if (m_highend) shadeBy(*m_highend, "shade highend", {&highendFrame});
      if (m_mobile) shadeBy(*m_mobile, "shade mobile", {&mobileFrame, compared ? &beforeTarget : nullptr});
      if (m_reference) {
        const base::Stopwatch watch(&m_context.timings(), "shade reference");
        const reference::Progress told = [&](double done) {
          if (progress) progress("reference", (partsDone + done) / parts);
        };
        const ReferenceSurface shaded = m_reference->shade(opaque, camera, stream, told);
        std::optional<ReferenceSurface> over;
        if (layer) over = m_reference->shade(blended, camera, stream + 1, {});
        referenceFrame.add(opaque, shaded.shaded, layer, layer ? &over->shaded : nullptr, tile);
        referenceError.add(opaque, shaded, layer, layer ? &*over : nullptr);
        sampledPoints += shaded.sampledPoints;
        lightSamples += shaded.lightSamples;
        if (over) {
          sampledPoints += over->sampledPoints;
          lightSamples += over->lightSamples;
        }
      }
      ++partsDone;
      stream += 2;
      if (!compared) continue;
      // The layer's opacity is the same in every path: it comes from the shared material.
      const base::Stopwatch watch(&m_context.timings(), "masks");
      coverage.add(opaque, layer, layer ? &shadedLayer : nullptr, tile);
      if (parts == 1 && settings.attribution == Attribution::overBudget && !settings.terms) m_kept = std::move(layers);
    }
  ViewFrames frames;
  if (m_highend) frames.highend = highendFrame.take();
  if (m_mobile) frames.mobile = mobileFrame.take();
  if (m_reference) {
    frames.reference = referenceFrame.take();
    frames.referenceError = referenceError.take(frames.reference.color);
    frames.referenceTaken = referenceError.samples();
    frames.referenceSamples =
        sampledPoints > 0 ? static_cast<double>(lightSamples) / static_cast<double>(sampledPoints) : 0;
    m_work.integratedSamples += sampledPoints;
    if (progress) progress("reference", 1);
  }
  if (compared) {
    frames.coverage = coverage.take();
    frames.mobileBeforeTarget = beforeTarget.take().color;
  }
  return frames;
}

void SceneRenderer::addTerms(ViewFrames& frames, const scenes::Camera& camera) {
  const Settings& settings = m_context.settings();
  assert(m_highend && m_mobile && !settings.terms);
  if (!m_highendTerms) { // for one view: whether there will be another is not known
    m_highendTerms = makeHighend(true, 1);
    m_mobileTerms = makeMobile(true, 1);
  }
  const auto width = static_cast<std::uint32_t>(settings.width), height = static_cast<std::uint32_t>(settings.height);
  gpu::FrameBuilder highendFrame(width, height, settings.samples, true, settings.background);
  gpu::FrameBuilder mobileFrame = highendFrame;
  for (const gpu::Tile& tile : gpu::makeTiles(width, height))
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples)) {
      std::optional<Layers> again;
      if (!m_kept) {
        again = rasterise(camera, tile, sample);
        m_again.surfaceSamples += again->opaque.size();
        m_again.blendedSamples += again->blended.size();
        if ((m_buffers.vertexData() & gpu::kVertexFog) != 0)
          m_again.fogSamples += again->opaque.size() + again->blended.size();
      }
      const base::Stopwatch watch(&m_context.timings(), "shade terms");
      const gpu::Surface& opaque = again ? again->opaque : m_kept->opaque;
      const gpu::Surface& blended = again ? again->blended : m_kept->blended;
      const gpu::Surface* layer = m_surfacePass.hasBlended() ? &blended : nullptr;
      m_again.termSamples += 2 * (opaque.size() + blended.size());
      const auto shadeBy = [&](const auto& renderer, gpu::FrameBuilder& frame) {
        const gpu::ShadedSurface shaded = renderer.shade(opaque, camera);
        std::optional<gpu::ShadedSurface> shadedLayer;
        if (layer) shadedLayer = renderer.shade(*layer, camera);
        frame.add(opaque, shaded, layer, layer ? &*shadedLayer : nullptr, tile);
      };
      shadeBy(*m_highendTerms, highendFrame);
      shadeBy(*m_mobileTerms, mobileFrame);
    }
  frames.highend.terms = highendFrame.take().terms;
  frames.mobile.terms = mobileFrame.take().terms;
}

std::vector<std::string> SceneRenderer::notes() const {
  return m_mobile ? m_mobile->notes() : std::vector<std::string>{};
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
  work.highendSamples = m_highend ? samplesOf(m_highend->pass()) : 0;
  work.mobileSamples = m_mobile ? samplesOf(m_mobile->pass()) : 0;
  if (m_highend) {
    work.directionalLights = m_highend->pass().directionalCount();
    work.localLights = m_highend->pass().localCount();
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
  why.blended = "no blended material";
  why.fog = "no fog";
  why.directional = !unlit.empty() ? unlit : "no directional light";
  why.local = !unlit.empty() ? unlit : "no local lights";
  why.lightChoice = work().localLights == 0 ? why.local : "the preset has them baked";
  why.terms = why.truth = why.occluders = why.costs = "not asked for";
  return why;
}

} // namespace parity::job
