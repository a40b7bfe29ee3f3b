#include "job/scene_renderer.h"

#include "base/parallel.h"
#include "job/environment_upload.h"
#include "job/permutation_costs.h"

namespace parity::job {

SceneRenderer::SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views)
    : m_context(context), m_prepared(prepared), m_buffers([&] {
        gpu::Device& device = context.device();
        const base::Stopwatch watch(&context.timings(), "upload");
        return gpu::SceneBuffers(device, prepared.scene, context.settings().specularAa);
      }()),
      m_surfacePass(context.device(), m_buffers, static_cast<std::uint32_t>(context.settings().width),
                    static_cast<std::uint32_t>(context.settings().height)) {
  const Settings& settings = context.settings();
  const gpu::Device& device = context.device();
  const auto pixels = static_cast<std::uint64_t>(settings.width) * settings.height * settings.samples * views;
  if (prepared.environment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_environment = uploadEnvironment(device, *prepared.environment);
  }
  if (prepared.mobileEnvironment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_mobileEnvironment = uploadCapture(device, *prepared.mobileEnvironment, settings.mobile.capture);
  }
  if (paths.highend) {
    highend::Inputs inputs{.environment = m_environment ? &*m_environment : nullptr,
                           .lut = nullptr,
                           .lights = prepared.lights,
                           .terms = settings.terms,
                           .expectedPixels = pixels};
    if (highend::Renderer::needsLut(inputs, settings.highend)) inputs.lut = &context.envBrdfLut();
    m_highend.emplace(device, m_buffers, m_surfacePass.binKinds(), inputs, settings.highend);
  }
  if (paths.mobile) {
    const mobile::Inputs inputs{.environment = m_mobileEnvironment ? &*m_mobileEnvironment : nullptr,
                                .lights = prepared.mobileLights,
                                .terms = settings.terms,
                                .view = settings.mobileView,
                                .expectedPixels = pixels};
    m_mobile.emplace(device, m_buffers, m_surfacePass.binKinds(), inputs, settings.mobile);
  }
  if (paths.reference) m_reference.emplace(context, prepared, m_buffers, m_surfacePass.binKinds(), pixels);
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
  const bool compared = m_highend && m_mobile; // masks are for comparing

  const std::vector<gpu::Tile> tiles = gpu::makeTiles(width, height);
  const double parts = static_cast<double>(tiles.size()) * settings.samples;
  double partsDone = 0;
  std::uint32_t stream = 0;
  for (const gpu::Tile& tile : tiles)
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples)) {
      gpu::Surface opaque, blended;
      {
        const base::Stopwatch watch(&m_context.timings(), "surface");
        opaque = m_surfacePass.render(camera, tile, sample, gpu::Layer::opaque);
        if (m_surfacePass.hasBlended()) blended = m_surfacePass.render(camera, tile, sample, gpu::Layer::blended);
      }
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
    if (progress) progress("reference", 1);
  }
  if (compared) {
    frames.coverage = coverage.take();
    frames.mobileBeforeTarget = beforeTarget.take().color;
  }
  return frames;
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

std::vector<std::string> SceneRenderer::skipped() const {
  std::vector<std::string> skipped;
  if (!m_prepared.environment) skipped.push_back("no environment: no prefiltered cube, no SH");
  if (!highend::Renderer::needsLut({.environment = m_environment ? &*m_environment : nullptr},
                                   m_context.settings().highend))
    skipped.push_back("no environment, no compensation, no balance: no environment BRDF table");
  bool directional = false, local = false;
  for (const scenes::Light& light : m_prepared.lights)
    (light.kind == scenes::LightKind::directional ? directional : local) = true;
  if (!directional) skipped.push_back("no directional light: no sun in the shaders");
  if (!local) skipped.push_back("no local lights: no light loop in the shaders");
  if (!m_prepared.scene.fog) skipped.push_back("no fog: none at vertices, none in the shaders");
  if (!m_surfacePass.hasBlended()) skipped.push_back("no blended material: no second surface");
  if (!m_context.settings().terms) skipped.push_back("terms not asked for: not written");
  return skipped;
}

} // namespace parity::job
