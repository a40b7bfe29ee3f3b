#include "gpu/surface/surface_pass.h"

#include <algorithm>
#include <array>
#include <map>

#include "gpu/surface/visibility_pass.h"
#include "gpu_shaders/resolve.comp.h"

namespace parity::gpu {

namespace {

struct ResolvePush {
  std::uint32_t count = 0;
  float jitterX = 0, jitterY = 0;
};

} // namespace

std::size_t VisibleLayers::size() const {
  std::size_t entries = 0;
  for (const Layer& layer : layers) entries += layer.entries.size();
  return entries;
}

struct SurfacePass::Impl {
  const Device& device;
  const SceneBuffers& scene;
  std::uint32_t width, height;
  VisibilityPass visibility;
  std::vector<BinKind> kinds;
  std::vector<std::uint32_t> keyOfInstance;
  Buffer viewBuffer;
  vk::raii::DescriptorSetLayout resolveSetLayout{nullptr};
  vk::raii::PipelineLayout resolveLayout{nullptr};
  vk::raii::Pipeline resolve{nullptr};

  Impl(const Device& dev, const SceneBuffers& buffers, std::uint32_t w, std::uint32_t h)
      : device(dev), scene(buffers), width(w), height(h), visibility(dev, buffers, w, h),
        viewBuffer(dev, sizeof(GpuView)) {
    groupMaterials();
  }

  void groupMaterials() {
    std::map<BinKind, std::uint32_t> known;
    const std::size_t materialCount = scene.scene().materials.size();
    for (std::size_t m = 0; m < materialCount; ++m)
      known[{scene.classOfMaterial()[m], scene.textures().setOfMaterial()[m]}] = 0;
    for (auto& [kind, key] : known) {
      key = static_cast<std::uint32_t>(kinds.size());
      kinds.push_back(kind);
    }
    for (const std::uint32_t m : scene.materialOfInstance())
      keyOfInstance.push_back(known[{scene.classOfMaterial()[m], scene.textures().setOfMaterial()[m]}]);
  }

  VisibleLayers::Layer makeLayer(const VisibilityPass::Ids& ids, const Tile& tile, bool blended) const {
    Bins bins = makeBins(ids, keyOfInstance, static_cast<std::uint32_t>(kinds.size()));
    orderByBlocks(bins, width);
    VisibleLayers::Layer layer{blended, std::move(bins.bins), {}};
    layer.entries.reserve(bins.entries.size());
    for (const std::uint32_t local : bins.entries) {
      const std::uint32_t x = local % width, y = local / width + tile.firstRow;
      layer.entries.emplace_back(x | y << 16, ids[local].x - 1, ids[local].y, 0);
    }
    return layer;
  }

  void resolveInto(Surface& surface, const scenes::Camera& camera, const glm::vec2& sample,
                   std::span<const glm::uvec4> entries);
};

void SurfacePass::Impl::resolveInto(Surface& surface, const scenes::Camera& camera, const glm::vec2& sample,
                                    std::span<const glm::uvec4> entries) {
  const std::uint32_t data = scene.vertexData();
  const vk::DeviceSize bytes = entries.size() * sizeof(glm::vec4);
  const auto make = [&](bool needed) { return Buffer(device, needed ? bytes : 0); };
  surface.position = make(true);
  surface.normal = make(true);
  surface.color = make(data & kVertexColors);
  surface.fog = make(data & kVertexFog);
  surface.uv = make(data & kVertexUvs);
  surface.uv0Derivatives = make(data & kVertexUvs);
  surface.uv1Derivatives = make((data & kVertexUvs) && (data & kVertexSecondUv));
  surface.tangent = make(data & kVertexTangents);
  surface.lightmap = make(data & kVertexLightmap);
  if (entries.empty()) return;

  const Buffer entryBuffer(device, entries);
  const GpuView view = makeView(scene.scene(), camera, width, height);
  viewBuffer.upload(std::as_bytes(std::span(&view, 1)));
  std::vector<Binding> bindings = {storage(scene.positions), storage(scene.normals), storage(scene.tangents),
                                   storage(scene.uvs),       storage(scene.colors),  storage(scene.indices),
                                   storage(scene.instances), storage(entryBuffer),   uniform(viewBuffer)};
  for (const Buffer* buffer :
       {&surface.position, &surface.normal, &surface.tangent, &surface.uv, &surface.uv0Derivatives,
        &surface.uv1Derivatives, &surface.color, &surface.fog, &surface.lightmap})
    bindings.push_back(storage(*buffer));
  bindings.push_back(storage(scene.lightmapCorners));
  if (!*resolve) {
    resolveSetLayout = makeSetLayout(device, bindings, vk::ShaderStageFlagBits::eCompute);
    resolveLayout = makePipelineLayout(device, std::array{*resolveSetLayout}, sizeof(ResolvePush),
                                       vk::ShaderStageFlagBits::eCompute);
    resolve = makeComputePipeline(device, resolveLayout, kResolveComp, std::array{data});
  }
  const DescriptorSets set(device, resolveSetLayout, std::span(&bindings, 1));
  const auto count = static_cast<std::uint32_t>(entries.size());
  device.submit("surface resolve", [&](const vk::raii::CommandBuffer& commands) {
    commands.bindPipeline(vk::PipelineBindPoint::eCompute, *resolve);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *resolveLayout, 0, set[0], {});
    commands.pushConstants<ResolvePush>(*resolveLayout, vk::ShaderStageFlagBits::eCompute, 0,
                                        ResolvePush{count, sample.x, sample.y});
    const std::uint32_t groups = (count + kGroupSize - 1) / kGroupSize;
    commands.dispatch(std::min(groups, kMaxGroupsInRow), (groups + kMaxGroupsInRow - 1) / kMaxGroupsInRow, 1);
    fullBarrier(commands);
  });
}

SurfacePass::SurfacePass(const Device& device, const SceneBuffers& scene, std::uint32_t width, std::uint32_t height)
    : m_impl(std::make_unique<Impl>(device, scene, width, height)) {}
SurfacePass::~SurfacePass() = default;
const std::vector<BinKind>& SurfacePass::binKinds() const { return m_impl->kinds; }

VisibleLayers SurfacePass::rasterise(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample) const {
  const VisibilityPass::Part part{camera, tile, sample};
  VisibleLayers visible;
  visible.sample = sample;
  visible.layers.push_back(m_impl->makeLayer(m_impl->visibility.renderOpaque(part), tile, false));
  for (std::uint32_t k = 0; m_impl->visibility.hasBlended(); ++k) {
    VisibleLayers::Layer layer = m_impl->makeLayer(m_impl->visibility.peel(part, k), tile, true);
    if (layer.entries.empty()) break;
    if (k == kMaxBlendedLayers) {
      for (const glm::uvec4& entry : layer.entries)
        visible.cutPixels.push_back((entry.x >> 16) * m_impl->width + (entry.x & 0xffffu));
      break;
    }
    visible.layers.push_back(std::move(layer));
  }
  std::reverse(visible.layers.begin() + 1, visible.layers.end());
  return visible;
}

VisibleLayers SurfacePass::rasteriseBehind(const scenes::Camera& camera, const Tile& tile,
                                           const glm::vec2& sample) const {
  VisibleLayers visible;
  visible.sample = sample;
  const bool withoutTransmissive = true;
  visible.layers.push_back(
      m_impl->makeLayer(m_impl->visibility.renderOpaque({camera, tile, sample}, withoutTransmissive), tile, false));
  return visible;
}

Surface SurfacePass::resolve(const VisibleLayers& visible, std::size_t layer, const scenes::Camera& camera) const {
  const VisibleLayers::Layer& seen = visible.layers[layer];
  Surface surface;
  surface.width = m_impl->width;
  surface.height = m_impl->height;
  surface.blended = seen.blended;
  surface.bins = seen.bins;
  surface.pixels.reserve(seen.entries.size());
  surface.instances.reserve(seen.entries.size());
  for (const glm::uvec4& entry : seen.entries) {
    surface.pixels.push_back((entry.x >> 16) * m_impl->width + (entry.x & 0xffffu));
    surface.instances.push_back(entry.y);
  }
  m_impl->resolveInto(surface, camera, visible.sample, seen.entries);
  return surface;
}

std::vector<Surface> SurfacePass::render(const scenes::Camera& camera, const Tile& tile,
                                         const glm::vec2& sample) const {
  const VisibleLayers visible = rasterise(camera, tile, sample);
  std::vector<Surface> surfaces;
  for (std::size_t k = 0; k < visible.layers.size(); ++k) surfaces.push_back(resolve(visible, k, camera));
  return surfaces;
}

} // namespace parity::gpu
