#include "job/scene_renderer.h"

#include <cassert>
#include <set>

#include <fmt/format.h>

#include "base/parallel.h"
#include "job/baked_upload.h"
#include "job/environment_upload.h"
#include "job/permutation_costs.h"
#include "job/term_variants.h"
#include "job/texture_codec.h"
#include "mobile/light_choice.h"

namespace parity::job {

namespace {

std::uint64_t pixelsOf(const Settings& settings, std::size_t views) {
  return static_cast<std::uint64_t>(settings.width) * settings.height * settings.samples * views;
}

// Entries of surfaces that wait to be shaded again: two of each pixel of a tile.
constexpr std::size_t kMaxKeptEntries = 2 * std::size_t{gpu::kMaxTilePixels};

bool hasOwnTextures(const Settings& settings, const Paths& paths) {
  return paths.mobile && settings.mobileTextures != base::TextureBlock::none;
}

// To be given to so many that read a scene's images: told once for an image, when the last of them has read it.
gpu::ImageDone afterReaders(int readers, std::size_t images, gpu::ImageDone onLastRead) {
  if (readers == 1 || !onLastRead) return onLastRead;
  return [left = std::make_shared<std::vector<int>>(images, readers), onLastRead](int image) {
    if (--left->at(static_cast<std::size_t>(image)) == 0) onLastRead(image);
  };
}

} // namespace

SceneRenderer::SceneRenderer(Context& context, const PreparedScene& prepared, const Paths& paths, std::size_t views,
                             const gpu::PermutationBudget& budget, gpu::ImageDone onLastRead)
    : m_context(context), m_prepared(prepared), m_views(views), m_budget(budget), m_work(prepared.work), m_buffers([&] {
        gpu::Device& device = context.device();
        const base::Stopwatch watch(&context.timings(), "upload");
        // A run of mobile alone reads the shared ones no further than alpha decides what is seen: before its own.
        const bool hasOwn = hasOwnTextures(context.settings(), paths), shares = paths.highend || paths.reference;
        onLastRead = afterReaders(hasOwn && shares ? 2 : 1, prepared.scene.images.size(), std::move(onLastRead));
        return gpu::SceneBuffers(device, prepared.scene, context.settings().specularAa,
                                 hasOwn && !shares ? gpu::ImageDone() : onLastRead,
                                 prepared.baked ? &prepared.baked->uvs : nullptr);
      }()),
      m_surfacePass(context.device(), m_buffers, static_cast<std::uint32_t>(context.settings().width),
                    static_cast<std::uint32_t>(context.settings().height)) {
  const gpu::Device& device = context.device();
  if (hasOwnTextures(context.settings(), paths) && m_buffers.textures().any())
    m_mobileTextures.emplace(device, prepared.scene, context.settings().specularAa == gpu::SpecularAa::toksvig,
                             std::move(onLastRead), makeTextureCodec(context, context.settings().mobileTextures));
  if (prepared.environment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_environment = uploadEnvironment(device, *prepared.environment, prepared.cells.get());
  }
  if (prepared.mobileEnvironment) {
    const base::Stopwatch watch(&context.timings(), "upload");
    m_mobileEnvironment = uploadCapture(device, *prepared.mobileEnvironment, context.settings().mobile.capture);
  }
  if (prepared.baked) uploadBaked(*prepared.baked, paths);
  if (paths.highend && prepared.shadows && prepared.isLit) {
    const base::Stopwatch watch(&context.timings(), "shadow maps");
    m_shadowMaps.emplace(device, m_buffers, prepared.lights, context.settings().shadowMaps);
  }
  m_mayDropLights = context.settings().droppedLights > 0 && paths.highend && paths.mobile && prepared.isLit &&
                    mobile::mayDropLights(prepared.mobileLights, context.settings().mobile.localLights);
  if (paths.highend) m_highend = makeHighend(context.settings().terms, views);
  if (const auto casting = mobile::Renderer::needsShadowMaps(prepared.mobileLights, context.settings().mobile);
      paths.mobile && prepared.isLit && !casting.empty()) {
    const base::Stopwatch watch(&context.timings(), "shadow maps");
    m_mobileShadowMaps.emplace(device, m_buffers, casting, context.settings().shadowMaps);
  }
  if (paths.mobile) m_mobile = makeMobile(context.settings().terms, views);
  if (m_mobileTextures && paths.highend) {
    mobile::Inputs inputs = mobileInputs(false, views);
    inputs.textures = nullptr;
    m_mobileOfOriginals = std::make_unique<mobile::Renderer>(device, m_buffers, m_surfacePass.binKinds(), inputs,
                                                             context.settings().mobile);
  }
  if (paths.reference) {
    m_reference.emplace(context, prepared, m_buffers, m_surfacePass.binKinds(), pixelsOf(context.settings(), views),
                        gpu::Compilation{budget, &context.pipelines()});
    if (prepared.shadows || prepared.bounces > 0) m_work.occluderMeshes = prepared.scene.meshes.size();
  }
}

void SceneRenderer::uploadBaked(const bake::BakedLight& baked, const Paths& paths) {
  const gpu::Device& device = m_context.device();
  const base::Stopwatch watch(&m_context.timings(), "upload");
  if (paths.highend) m_baked = uploadHighendBaked(device, baked);
  if (paths.mobile) m_mobileBaked = uploadMobileBaked(device, baked);
  m_work.lightmapPages = baked.mobile.size();
  m_work.captures = baked.captures.size();
  if (baked.captures.empty()) return;
  if (paths.highend) m_environment = uploadHighendCaptures(device, baked);
  if (paths.mobile) m_mobileEnvironment = uploadMobileCaptures(device, baked, m_context.settings().mobile.capture);
}

std::unique_ptr<highend::Renderer> SceneRenderer::makeHighend(bool terms, std::size_t views) {
  const Settings& settings = m_context.settings();
  highend::Inputs inputs{.environment = m_environment ? &*m_environment : nullptr,
                         .lut = nullptr,
                         .lights = m_prepared.isLit ? m_prepared.lights : std::vector<scenes::Light>(),
                         .shadows = m_shadowMaps ? &*m_shadowMaps : nullptr,
                         .baked = m_baked ? &*m_baked : nullptr,
                         .terms = terms,
                         .view = settings.highendView,
                         .compilation = {m_budget, &m_context.pipelines()},
                         .expectedPixels = pixelsOf(settings, views)};
  if (highend::Renderer::needsLut(inputs, settings.highend)) {
    inputs.lut = &m_context.envBrdfLut();
    m_work.brdfTables = 1;
  }
  return std::make_unique<highend::Renderer>(m_context.device(), m_buffers, m_surfacePass.binKinds(), inputs,
                                             settings.highend);
}

mobile::Inputs SceneRenderer::mobileInputs(bool terms, std::size_t views) {
  const Settings& settings = m_context.settings();
  return {.environment = m_mobileEnvironment ? &*m_mobileEnvironment : nullptr,
          .lights = m_prepared.isLit ? m_prepared.mobileLights : std::vector<scenes::Light>(),
          .shadows = m_mobileShadowMaps ? &*m_mobileShadowMaps : nullptr,
          .textures = m_mobileTextures ? &*m_mobileTextures : nullptr,
          .baked = m_mobileBaked ? &*m_mobileBaked : nullptr,
          .terms = terms,
          .view = settings.mobileView,
          .compilation = {m_budget, &m_context.pipelines()},
          .expectedPixels = pixelsOf(settings, views)};
}

std::unique_ptr<mobile::Renderer> SceneRenderer::makeMobile(bool terms, std::size_t views) {
  return std::make_unique<mobile::Renderer>(m_context.device(), m_buffers, m_surfacePass.binKinds(),
                                            mobileInputs(terms, views), m_context.settings().mobile);
}

gpu::VisibleLayers SceneRenderer::rasterise(const scenes::Camera& camera, const gpu::Tile& tile,
                                            const glm::vec2& sample) {
  const base::Stopwatch watch(&m_context.timings(), "surface");
  return m_surfacePass.rasterise(camera, tile, sample);
}

gpu::Surface SceneRenderer::resolve(const gpu::VisibleLayers& visible, std::size_t layer,
                                    const scenes::Camera& camera) {
  const base::Stopwatch watch(&m_context.timings(), "surface");
  return m_surfacePass.resolve(visible, layer, camera);
}

void SceneRenderer::countSurface(const gpu::Surface& surface, Work& work) const {
  (surface.blended ? work.blendedSamples : work.surfaceSamples) += surface.size();
  if ((m_buffers.vertexData() & gpu::kVertexFog) != 0) work.fogSamples += surface.size();
}

// Uploads what shading them will read, once for all paths and layers.
void SceneRenderer::requireTextures(const gpu::VisibleLayers& visible) {
  std::vector<gpu::Textures::Need> needs;
  for (const gpu::VisibleLayers::Layer& layer : visible.layers)
    for (const gpu::Textures::Need& need : gpu::texturesOf(layer.bins, m_surfacePass.binKinds())) needs.push_back(need);
  if (!m_mobileTextures || m_highend || m_reference) {
    const base::Stopwatch watch(&m_context.timings(), "upload");
    m_buffers.textures().require(needs);
  }
  if (m_mobileTextures) {
    const base::Stopwatch watch(&m_context.timings(), "compress textures");
    m_mobileTextures->require(needs);
  }
}

ViewFrames SceneRenderer::render(const scenes::Camera& camera, const Progress& progress) {
  const Settings& settings = m_context.settings();
  const Paths paths{
      .highend = m_highend != nullptr, .mobile = m_mobile != nullptr, .reference = m_reference.has_value()};
  std::optional<gpu::TargetCodec> target;
  if (settings.mobileView == mobile::kViewLit)
    target.emplace(settings.mobileTarget, m_prepared.exposureEv,
                   mobile::precisionOn(m_context.device().report(), settings.mobile) == mobile::Precision::fp16);
  ViewBuilder view(settings, paths, m_buffers, target, m_mobileOfOriginals != nullptr);
  std::set<std::uint32_t> cutPixels;
  m_kept.clear();
  m_seenSamples.assign(m_mayDropLights ? m_prepared.scene.instances.size() : 0, 0);

  const std::vector<gpu::Tile> tiles =
      gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height));
  const std::size_t parts = tiles.size() * static_cast<std::size_t>(settings.samples);
  std::size_t part = 0;
  for (const gpu::Tile& tile : tiles)
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples)) {
      const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
      cutPixels.insert(visible.cutPixels.begin(), visible.cutPixels.end());
      requireTextures(visible);
      const bool mayAddTerms =
          paths.highend && paths.mobile && !settings.terms && settings.attribution == Attribution::overBudget;
      const bool keeps = parts == 1 && (mayAddTerms || m_mayDropLights) && visible.size() <= kMaxKeptEntries;
      const std::size_t layerCount = visible.layers.size();
      view.begin(tile);
      // From the back to the front, as hardware blends; one layer's surface at a time.
      for (std::size_t k = 0; k < layerCount; ++k) {
        gpu::Surface surface = resolve(visible, k, camera);
        if (m_mayDropLights)
          for (const std::uint32_t instance : surface.instances) ++m_seenSamples[instance];
        // Apart from each other, and the nearest layer's the same however many lie behind.
        const std::size_t fromFront = layerCount - 1 - k, stream = 2 * part + (k == 0 ? 0 : 1 + 2 * parts * fromFront);
        const auto told = [&](double done) {
          const double share = (static_cast<double>(k) + done) / static_cast<double>(layerCount);
          if (progress) progress("reference", (static_cast<double>(part) + share) / static_cast<double>(parts));
        };
        shade(surface, camera, static_cast<std::uint32_t>(stream), told, view);
        if (keeps) m_kept.push_back(std::move(surface));
      }
      const base::Stopwatch watch(&m_context.timings(), "compose");
      view.end();
      ++part;
    }
  m_cutPixels += cutPixels.size();
  m_work.integratedSamples += view.sampledPoints();
  if (m_reference && progress) progress("reference", 1);
  return view.take();
}

void SceneRenderer::shade(const gpu::Surface& surface, const scenes::Camera& camera, std::uint32_t stream,
                          const reference::Progress& progress, ViewBuilder& view) {
  countSurface(surface, m_work);
  const auto begin = [&](const char* stage) {
    if (m_context.settings().terms) m_work.termSamples += surface.size();
    return base::Stopwatch(&m_context.timings(), stage);
  };
  std::optional<gpu::ShadedSurface> highend, mobile;
  std::optional<ReferenceSurface> reference;
  if (m_highend) {
    const base::Stopwatch watch = begin("shade highend");
    highend = m_highend->shade(surface, camera);
    view.layHighend(surface, *highend);
  }
  if (m_mobile) {
    const base::Stopwatch watch = begin("shade mobile");
    mobile = m_mobile->shade(surface, camera);
    view.layMobile(surface, *mobile);
    if (m_mobileOfOriginals) view.layMobileOfOriginals(surface, m_mobileOfOriginals->shade(surface, camera));
  }
  if (m_reference) {
    const base::Stopwatch watch = begin("shade reference");
    reference = m_reference->shade(surface, camera, stream, progress);
    view.layReference(surface, *reference);
    m_work.resolvedSamples += surface.size();
  }
  if (!highend || !mobile) return;
  const base::Stopwatch watch(&m_context.timings(), "compose");
  view.laySwaps(surface, *highend, *mobile, reference ? &reference->shaded : nullptr);
}

void SceneRenderer::addTerms(ViewFrames& frames, const scenes::Camera& camera,
                             const std::vector<std::size_t>& materials) {
  const Settings& settings = m_context.settings();
  assert(m_highend && m_mobile && !settings.terms);
  if (!m_highendTerms) { // for one view: whether there will be another is not known
    m_highendTerms = makeHighend(true, 1);
    m_mobileTerms = makeMobile(true, 1);
  }
  gpu::FrameBuilder highendFrame = makeFrame(true), mobileFrame = makeFrame(true);
  std::vector<char> wanted(m_prepared.scene.materials.size(), 0);
  for (const std::size_t material : materials) wanted[material] = 1;
  gpu::SwapBuilder variants(m_buffers.materialOfInstance(), m_prepared.scene.materials.size(),
                            static_cast<std::uint32_t>(settings.width), settings.samples,
                            std::vector<glm::vec3>(TermVariants::kPlanes, settings.background), std::nullopt,
                            std::move(wanted));
  const auto lay = [&](const gpu::Surface& surface) {
    const base::Stopwatch watch(&m_context.timings(), "shade terms");
    m_again.termSamples += 2 * surface.size();
    const gpu::ShadedSurface highend = m_highendTerms->shade(surface, camera),
                             mobile = m_mobileTerms->shade(surface, camera);
    highendFrame.lay(surface, highend);
    mobileFrame.lay(surface, mobile);
    variants.lay(surface, highend, mobile, TermVariants(surface, highend, mobile).planes());
  };
  layAgain(camera, m_again,
           {[&](const gpu::Tile& tile) { highendFrame.begin(tile), mobileFrame.begin(tile), variants.begin(tile); },
            lay, [&] { highendFrame.end(), mobileFrame.end(), variants.end(); }});
  frames.highend.terms = highendFrame.take().terms;
  frames.mobile.terms = mobileFrame.take().terms;
  frames.termVariants = variants.take(frames.coverage, {});
}

base::Image SceneRenderer::renderWithout(std::size_t light, const scenes::Camera& camera) {
  assert(m_highend && m_mayDropLights);
  if (!m_highendSwitched) m_highendSwitched = makeHighend(false, m_views);
  gpu::FrameBuilder frame = makeFrame(false);
  m_highendSwitched->switchLight(light, false);
  const auto lay = [&](const gpu::Surface& surface) {
    const base::Stopwatch watch(&m_context.timings(), "shade without a light");
    frame.lay(surface, m_highendSwitched->shade(surface, camera));
  };
  layAgain(camera, m_work, {[&](const gpu::Tile& tile) { frame.begin(tile); }, lay, [&] { frame.end(); }});
  m_highendSwitched->switchLight(light, true);
  ++m_work.lightPictures;
  return frame.take().color;
}

gpu::FrameBuilder SceneRenderer::makeFrame(bool terms) const {
  const Settings& settings = m_context.settings();
  return {static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height), settings.samples,
          terms, settings.background};
}

void SceneRenderer::layAgain(const scenes::Camera& camera, Work& work, const Composition& composition) {
  const Settings& settings = m_context.settings();
  for (const gpu::Tile& tile :
       gpu::makeTiles(static_cast<std::uint32_t>(settings.width), static_cast<std::uint32_t>(settings.height)))
    for (const glm::vec2& sample : gpu::samplePositions(settings.samples)) {
      composition.begin(tile);
      if (!m_kept.empty()) {
        for (const gpu::Surface& surface : m_kept) composition.lay(surface);
      } else {
        const gpu::VisibleLayers visible = rasterise(camera, tile, sample);
        for (std::size_t k = 0; k < visible.layers.size(); ++k) {
          const gpu::Surface surface = resolve(visible, k, camera);
          countSurface(surface, work);
          composition.lay(surface);
        }
      }
      composition.end();
    }
}

} // namespace parity::job
