#include "job/scene/scene_on_device.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "job/scene/texture_codec.h"

namespace parity::job {

namespace {

// Blocks that the chosen paths' textures are compressed in.
std::set<base::TextureBlock> blocksOf(const PathChoice& paths, const paths::Options& options) {
  std::set<base::TextureBlock> blocks;
  for (const paths::Path* path : paths.chosen) blocks.insert(path->textureBlock(options));
  blocks.erase(base::TextureBlock::none);
  return blocks;
}

// Comparing paths shades by the scene's textures, too: what compression alone makes is measured.
bool sharesTextures(const PathChoice& paths, const paths::Options& options) {
  bool shares = paths.truth || paths.compares();
  for (const paths::Path* path : paths.chosen) shares |= path->textureBlock(options) == base::TextureBlock::none;
  return shares;
}

// To be given to so many that read a scene's images: told once for an image, when the last of them has read it.
gpu::ImageDone afterReaders(std::size_t readers, std::size_t images, gpu::ImageDone onLastRead) {
  if (readers == 1 || !onLastRead) return onLastRead;
  return [left = std::make_shared<std::vector<std::size_t>>(images, readers), onLastRead](int image) {
    if (--left->at(static_cast<std::size_t>(image)) == 0) onLastRead(image);
  };
}

// The panorama without the sky light's colour, which shaders multiply.
scenes::Environment uncolored(scenes::Environment panorama, const glm::vec3& skyLightColor) {
  std::vector<float>& pixels = panorama.radiance.pixels;
  for (std::size_t i = 0; i < pixels.size(); ++i)
    if (const float color = skyLightColor[static_cast<int>(i % 3)]; color > 0) pixels[i] /= color;
  return panorama;
}

} // namespace

SceneOnDevice::SceneOnDevice(Context& context, const PreparedScene& prepared, const Settings& settings,
                             const PathChoice& paths, gpu::ImageDone onLastRead)
    : m_context(context), m_prepared(prepared), m_settings(settings),
      m_sharesTextures(sharesTextures(paths, settings.options)),
      // If every path has its own textures, only the alpha test reads the shared ones, before the paths read theirs.
      m_onLastRead(afterReaders(blocksOf(paths, settings.options).size() + (m_sharesTextures ? 1 : 0),
                                prepared.scene.images.size(), std::move(onLastRead))),
      m_buffers([&] {
        gpu::Device& device = context.device();
        const base::Stopwatch watch(&context.timings(), "upload");
        return gpu::SceneBuffers(device, prepared.scene, settings.specularAa,
                                 m_sharesTextures ? m_onLastRead : gpu::ImageDone(),
                                 prepared.baked ? &prepared.baked->uvs : nullptr);
      }()),
      m_surfacePass(context.device(), m_buffers, static_cast<std::uint32_t>(settings.width),
                    static_cast<std::uint32_t>(settings.height)) {
  for (const base::TextureBlock block : blocksOf(paths, settings.options)) texturesIn(block);
}

bool SceneOnDevice::hasOwnTextures(const paths::Path& path, const paths::Options& options) const {
  return path.textureBlock(options) != base::TextureBlock::none && m_buffers.textures().any();
}

const gpu::Textures* SceneOnDevice::texturesIn(base::TextureBlock block) {
  if (block == base::TextureBlock::none || !m_buffers.textures().any()) return nullptr;
  return &m_compressed
              .try_emplace(block, m_context.device(), m_prepared.scene,
                           m_settings.specularAa == gpu::SpecularAa::toksvig, m_onLastRead,
                           makeTextureCodec(m_context, block))
              .first->second;
}

// What other options than the scene's read of the environment is made here.
const paths::Light& SceneOnDevice::lightFor(const paths::Path& path, const paths::Options& options) {
  const paths::Light& light = lightOf(m_prepared, path);
  const paths::LightNeeds needs = path.lightNeeds(options);
  if (!light.environment || !m_prepared.panorama ||
      needs.prefilter == path.lightNeeds(m_prepared.settings.options).prefilter)
    return light;
  const auto& [faceSize, sampleCount, footprintLog2, levels] = needs.prefilter;
  return *m_store.get(
      fmt::format("light of {} {} {} {} {}", path.name(), faceSize, sampleCount, footprintLog2,
                  static_cast<int>(levels)),
      [&] {
        paths::Light other = light;
        other.environment = std::make_shared<const lighting::EnvironmentLight>(lighting::makeEnvironmentLight(
            uncolored(*m_prepared.panorama, m_prepared.scene.lightScales.skyLightColor), needs.prefilter));
        return other;
      });
}

std::unique_ptr<paths::Renderer> SceneOnDevice::makeRenderer(const paths::Path& path, const paths::Options& options,
                                                             const RendererWish& wish) {
  static const paths::Light kDark;
  return path.makeRenderer({.device = m_context.device(),
                            .buffers = m_buffers,
                            .binKinds = m_surfacePass.binKinds(),
                            .light = wish.light         ? *wish.light
                                     : m_prepared.isLit ? lightFor(path, options)
                                                        : kDark,
                            .isLit = m_prepared.isLit,
                            .baked = m_prepared.baked.get(),
                            .textures = wish.originalTextures ? nullptr : texturesIn(path.textureBlock(options)),
                            .asksForShadows = m_prepared.settings.shadows,
                            .shadowMaps = m_settings.shadowMaps,
                            .onlyCompiles = wish.light != nullptr,
                            .terms = wish.terms,
                            .leftOut = wish.leftOut,
                            .lightsAlone = wish.lightsAlone,
                            .hiddenFeatures = wish.hiddenFeatures,
                            .wide = wish.wide,
                            .intermediate = wish.intermediate,
                            .compilation = {wish.budget, &m_context.pipelines(), wish.plan, wish.planWritesTerms},
                            .expectedPixels = wish.expectedPixels,
                            .services = m_context.services(),
                            .store = m_store},
                           options);
}

void SceneOnDevice::requireTextures(const gpu::VisibleLayers& visible) {
  std::vector<gpu::Textures::Need> needs;
  for (const gpu::VisibleLayers::Layer& layer : visible.layers)
    for (const gpu::Textures::Need& need : gpu::texturesOf(layer.bins, m_surfacePass.binKinds())) needs.push_back(need);
  if (m_sharesTextures || m_compressed.empty()) {
    const base::Stopwatch watch(&m_context.timings(), "upload");
    m_buffers.textures().require(needs);
  }
  for (auto& [block, textures] : m_compressed) {
    const base::Stopwatch watch(&m_context.timings(), "compress textures");
    textures.require(needs);
  }
}

std::uint64_t SceneOnDevice::compressedImages() const {
  std::uint64_t images = 0;
  for (const auto& [block, textures] : m_compressed) images += textures.uploadedCount();
  return images;
}

} // namespace parity::job
