#include "gpu/surface_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "gpu/graphics_pipeline.h"
#include "gpu_shaders/resolve.comp.h"

namespace parity::gpu {

namespace {

struct RasterPush {
  glm::mat4 toClip;
  std::uint32_t instance = 0, vertexData = 0;
};
struct ResolvePush {
  std::uint32_t count = 0;
  float jitterX = 0, jitterY = 0;
};

std::vector<Binding> geometryBindings(const SceneBuffers& s) {
  return {storage(s.positions), storage(s.normals), storage(s.tangents),  storage(s.uvs),
          storage(s.colors),    storage(s.indices), storage(s.instances), storage(s.materials)};
}

} // namespace

std::vector<Tile> makeTiles(std::uint32_t width, std::uint32_t height) {
  const std::uint32_t rows = std::max(1u, kMaxTilePixels / width);
  std::vector<Tile> tiles;
  for (std::uint32_t row = 0; row < height; row += rows) tiles.push_back({row, std::min(rows, height - row)});
  return tiles;
}

std::vector<glm::vec2> samplePositions(int count) {
  std::vector<glm::vec2> positions;
  const double half = 0.5 / count;
  for (int i = 0; i < count; ++i) {
    double radicalInverse = 0, digit = 0.5;
    for (int bits = i; bits > 0; bits >>= 1, digit /= 2) radicalInverse += digit * (bits & 1);
    positions.emplace_back(i * 2 * half + half, std::fmod(radicalInverse + half, 1.0));
  }
  return positions;
}

glm::mat4 makeWorldToClip(const scenes::Camera& camera, float aspect) {
  const float n = camera.zNear, f = camera.zFar;
  glm::mat4 projection(0.f);
  if (camera.orthographic) {
    projection[0][0] = 1 / (camera.halfHeight * aspect);
    projection[1][1] = 1 / camera.halfHeight;
    projection[2][2] = 1 / (n - f);
    projection[3][2] = n / (n - f);
    projection[3][3] = 1;
  } else {
    const float tangent = std::tan(glm::radians(camera.fovYDeg) / 2);
    projection[0][0] = 1 / (tangent * aspect);
    projection[1][1] = 1 / tangent;
    projection[2][2] = f / (n - f);
    projection[3][2] = n * f / (n - f);
    projection[2][3] = -1;
  }
  return projection * glm::inverse(camera.toWorld);
}

GpuView makeView(const scenes::Scene& scene, const scenes::Camera& camera, std::uint32_t width, std::uint32_t height) {
  const glm::vec3 right(camera.toWorld[0]), up(camera.toWorld[1]), back(camera.toWorld[2]), eye(camera.toWorld[3]);
  const float aspect = static_cast<float>(width) / static_cast<float>(height);
  const float halfHeight = camera.orthographic ? camera.halfHeight : std::tan(glm::radians(camera.fovYDeg) / 2);
  const float halfWidth = halfHeight * aspect;
  // The picture plane from its top left corner, a pixel to the right, a pixel down.
  const glm::vec3 corner = halfHeight * up - halfWidth * right;
  const glm::vec3 stepX = 2 * halfWidth / static_cast<float>(width) * right,
                  stepY = -2 * halfHeight / static_cast<float>(height) * up;
  GpuView view{};
  const bool o = camera.orthographic;
  view.eye = vec4(eye, o ? 1.f : 0.f);
  view.viewer = o ? vec4(back, 0) : vec4(eye, 1);
  view.origin = o ? vec4(corner, 0) : vec4(0.f);
  view.originX = o ? vec4(stepX, 0) : vec4(0.f);
  view.originY = o ? vec4(stepY, 0) : vec4(0.f);
  view.direction = vec4(o ? -back : corner - back, 0);
  view.directionX = o ? vec4(0.f) : vec4(stepX, 0);
  view.directionY = o ? vec4(0.f) : vec4(stepY, 0);
  view.skyLightColor = vec4(scene.lightScales.skyLightColor, 0);
  view.indirectColorScale = vec4(scene.lightScales.indirectColorScale, 0);
  if (const auto& fog = scene.fog) {
    view.fog = vec4(fog->density, fog->heightFalloff, fog->height, fog->startDistance);
    view.fogColor = vec4(fog->color, fog->maxOpacity);
  }
  return view;
}

struct SurfacePass::Impl {
  const Device& device;
  const SceneBuffers& scene;
  std::uint32_t width, height;
  std::vector<BinKind> kinds;
  std::vector<std::uint32_t> keyOfInstance;
  bool blended = false;
  std::uint32_t tileRows;
  DeviceImage ids, depth;
  Buffer idsOut;
  Buffer viewBuffer;
  std::vector<Binding> geometry;
  vk::raii::DescriptorSetLayout geometryLayout, textureLayout;
  vk::raii::PipelineLayout rasterLayout;
  vk::raii::Pipeline plain{nullptr}, masked{nullptr};
  std::unique_ptr<DescriptorSets> geometrySet, textureSets;
  vk::raii::DescriptorSetLayout resolveSetLayout{nullptr};
  vk::raii::PipelineLayout resolveLayout{nullptr};
  vk::raii::Pipeline resolve{nullptr};

  Impl(const Device& dev, const SceneBuffers& buffers, std::uint32_t w, std::uint32_t h)
      : device(dev), scene(buffers), width(w), height(h), tileRows(makeTiles(w, h).front().rows),
        ids(dev, {.format = vk::Format::eR32G32Uint,
                  .width = w,
                  .height = tileRows,
                  .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc}),
        depth(dev, {.format = vk::Format::eD32Sfloat,
                    .width = w,
                    .height = tileRows,
                    .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment}),
        idsOut(dev, vk::DeviceSize{w} * tileRows * sizeof(glm::uvec2)), viewBuffer(dev, sizeof(GpuView)),
        geometry(geometryBindings(buffers)), geometryLayout(makeSetLayout(dev, geometry, kRasterStages)),
        textureLayout(makeSetLayout(dev, std::vector<Binding>{buffers.textures().bindings({}).front()}, kRasterStages)),
        rasterLayout(
            makePipelineLayout(dev, std::array{*geometryLayout, *textureLayout}, sizeof(RasterPush), kRasterStages)) {
    groupMaterials();
    plain = makeVisibilityPipeline(device, rasterLayout, false);
    geometrySet = std::make_unique<DescriptorSets>(device, geometryLayout, std::span(&geometry, 1));
    // Only alpha is read here, and only where it decides what is seen.
    std::vector<Textures::Need> needs(scene.textures().setCount());
    for (std::uint32_t set = 0; set < needs.size(); ++set) needs[set].set = set;
    bool anyTested = false;
    for (const std::uint32_t m : scene.materialOfInstance()) {
      if (scene.scene().materials[m].alphaMode == scenes::AlphaMode::opaque) continue;
      needs[scene.textures().setOfMaterial()[m]].slots = 1u << kSlotBaseColor;
      anyTested = true;
    }
    scene.textures().require(needs);
    std::vector<std::vector<Binding>> sets;
    for (const Textures::Need& need : needs) sets.push_back({scene.textures().bindings(need).front()});
    textureSets = std::make_unique<DescriptorSets>(device, textureLayout, sets);
    if (anyTested) masked = makeVisibilityPipeline(device, rasterLayout, true);
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
    for (const std::uint32_t m : scene.materialOfInstance()) {
      keyOfInstance.push_back(known[{scene.classOfMaterial()[m], scene.textures().setOfMaterial()[m]}]);
      blended |= scene.scene().materials[m].alphaMode == scenes::AlphaMode::blend;
    }
  }

  void drawInstances(const vk::raii::CommandBuffer& commands, const glm::mat4& worldToClip, Layer layer) const;
  std::vector<glm::uvec2> rasterise(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample,
                                    Layer layer) const;
  void resolveInto(Surface& surface, const scenes::Camera& camera, const glm::vec2& sample,
                   std::span<const glm::uvec4> entries);
};

void SurfacePass::Impl::drawInstances(const vk::raii::CommandBuffer& commands, const glm::mat4& worldToClip,
                                      Layer layer) const {
  const scenes::Scene& s = scene.scene();
  commands.bindIndexBuffer(scene.indices.handle(), 0, vk::IndexType::eUint32);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *rasterLayout, 0, (*geometrySet)[0], {});
  for (std::uint32_t i = 0; i < s.instances.size(); ++i) {
    const scenes::Instance& instance = s.instances[i];
    const std::uint32_t materialIndex = scene.materialOfInstance()[i];
    const scenes::Material& material = s.materials[materialIndex];
    if ((material.alphaMode == scenes::AlphaMode::blend) != (layer == Layer::blended)) continue;
    const bool tested = material.alphaMode != scenes::AlphaMode::opaque;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, tested ? *masked : *plain);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *rasterLayout, 1,
                                (*textureSets)[scene.textures().setOfMaterial()[materialIndex]], {});
    commands.setCullMode(material.doubleSided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    commands.setFrontFace(glm::determinant(glm::mat3(instance.toWorld)) < 0 ? vk::FrontFace::eClockwise
                                                                            : vk::FrontFace::eCounterClockwise);
    commands.pushConstants<RasterPush>(*rasterLayout, kRasterStages, 0,
                                       RasterPush{worldToClip * instance.toWorld, i, scene.vertexData()});
    const SceneBuffers::MeshRange& range = scene.meshes()[instance.mesh];
    commands.drawIndexed(range.indexCount, 1, range.firstIndex, static_cast<std::int32_t>(range.baseVertex), 0);
  }
}

std::vector<glm::uvec2> SurfacePass::Impl::rasterise(const scenes::Camera& camera, const Tile& tile,
                                                     const glm::vec2& sample, Layer layer) const {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  device.submit("surface raster", [&](const vk::raii::CommandBuffer& commands) {
    changeLayout(commands, ids, vk::ImageLayout::eUndefined, vk::ImageLayout::eColorAttachmentOptimal);
    const bool keepDepth = layer == Layer::blended;
    changeLayout(commands, depth,
                 keepDepth ? vk::ImageLayout::eDepthStencilAttachmentOptimal : vk::ImageLayout::eUndefined,
                 vk::ImageLayout::eDepthStencilAttachmentOptimal);
    const vk::RenderingAttachmentInfo color(ids.view(), vk::ImageLayout::eColorAttachmentOptimal, {}, {}, {},
                                            vk::AttachmentLoadOp::eClear, vk::AttachmentStoreOp::eStore,
                                            vk::ClearColorValue(std::array<std::uint32_t, 4>{}));
    const vk::RenderingAttachmentInfo depthInfo(depth.view(), vk::ImageLayout::eDepthStencilAttachmentOptimal, {}, {},
                                                {},
                                                keepDepth ? vk::AttachmentLoadOp::eLoad : vk::AttachmentLoadOp::eClear,
                                                vk::AttachmentStoreOp::eStore, vk::ClearDepthStencilValue(1.f, 0));
    const vk::Rect2D area({0, 0}, {width, tile.rows});
    commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color, &depthInfo));
    // The whole picture's viewport, moved so that the tile's first row comes first and the sample lies at the pixel
    // centre.
    const float x = 0.5f - sample.x, y = 0.5f - sample.y - static_cast<float>(tile.firstRow);
    commands.setViewport(0, vk::Viewport(x, y + h, w, -h, 0, 1));
    commands.setScissor(0, area);
    drawInstances(commands, makeWorldToClip(camera, w / h), layer);
    commands.endRendering();
    changeLayout(commands, ids, vk::ImageLayout::eColorAttachmentOptimal, vk::ImageLayout::eTransferSrcOptimal);
    commands.copyImageToBuffer(
        ids.handle(), vk::ImageLayout::eTransferSrcOptimal, idsOut.handle(),
        vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {width, tile.rows, 1}));
  });
  return idsOut.downloadAs<glm::uvec2>(std::size_t{width} * tile.rows);
}

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
  surface.uv1Derivatives = make(data & kVertexUvs);
  surface.tangent = make(data & kVertexTangents);
  if (entries.empty()) return;

  const Buffer entryBuffer(device, entries);
  const GpuView view = makeView(scene.scene(), camera, width, height);
  viewBuffer.upload(std::as_bytes(std::span(&view, 1)));
  std::vector<Binding> bindings(geometry.begin(), geometry.end() - 1); // without the materials
  bindings.push_back(storage(entryBuffer));
  bindings.push_back(uniform(viewBuffer));
  for (const Buffer* buffer : {&surface.position, &surface.normal, &surface.tangent, &surface.uv,
                               &surface.uv0Derivatives, &surface.uv1Derivatives, &surface.color, &surface.fog})
    bindings.push_back(storage(*buffer));
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
bool SurfacePass::hasBlended() const { return m_impl->blended; }

Surface SurfacePass::render(const scenes::Camera& camera, const Tile& tile, const glm::vec2& sample,
                            Layer layer) const {
  const std::vector<glm::uvec2> ids = m_impl->rasterise(camera, tile, sample, layer);
  Bins bins = makeBins(ids, m_impl->keyOfInstance, static_cast<std::uint32_t>(m_impl->kinds.size()));
  Surface surface;
  surface.width = m_impl->width;
  surface.height = m_impl->height;
  surface.bins = std::move(bins.bins);
  std::vector<glm::uvec4> entries(bins.entries.size());
  surface.pixels.resize(entries.size());
  surface.instances.resize(entries.size());
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const std::uint32_t local = bins.entries[i], x = local % m_impl->width, y = local / m_impl->width + tile.firstRow;
    entries[i] = {x | y << 16, ids[local].x - 1, ids[local].y, 0};
    surface.pixels[i] = y * m_impl->width + x;
    surface.instances[i] = ids[local].x - 1;
  }
  m_impl->resolveInto(surface, camera, sample, entries);
  return surface;
}

} // namespace parity::gpu
