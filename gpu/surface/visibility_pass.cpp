#include "gpu/surface/visibility_pass.h"

#include <array>
#include <optional>

#include "gpu/device/graphics_pipeline.h"

namespace parity::gpu {

namespace {

constexpr auto kColor = vk::ImageLayout::eColorAttachmentOptimal;

std::vector<Binding> geometryBindings(const SceneBuffers& s) {
  return {storage(s.positions), storage(s.normals), storage(s.tangents),  storage(s.uvs),
          storage(s.colors),    storage(s.indices), storage(s.instances), storage(s.materials)};
}

DeviceImage makeIds(const Device& device, std::uint32_t width, std::uint32_t rows) {
  return DeviceImage(device, {.format = vk::Format::eR32G32Uint,
                              .width = width,
                              .height = rows,
                              .usage = vk::ImageUsageFlagBits::eColorAttachment | vk::ImageUsageFlagBits::eTransferSrc |
                                       vk::ImageUsageFlagBits::eSampled});
}

DeviceImage makeDepth(const Device& device, std::uint32_t width, std::uint32_t rows) {
  return DeviceImage(device,
                     {.format = vk::Format::eD32Sfloat,
                      .width = width,
                      .height = rows,
                      .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled});
}

} // namespace

struct VisibilityPass::Impl {
  const Device& device;
  const SceneBuffers& scene;
  std::uint32_t width, height, tileRows;
  bool blended = false;
  // Layers of blended surfaces are written by turns, so that each can read the one before.
  std::array<DeviceImage, 2> ids, peeledDepth;
  DeviceImage depth; // of opaque surfaces
  Buffer idsOut;
  std::vector<Binding> geometry;
  vk::raii::DescriptorSetLayout geometryLayout, textureLayout, peelSetLayout{nullptr};
  vk::raii::PipelineLayout rasterLayout, peelLayout{nullptr};
  vk::raii::Pipeline plain{nullptr}, masked{nullptr}, peeling{nullptr};
  vk::raii::Sampler sampler;
  std::unique_ptr<DescriptorSets> geometrySet, textureSets, peelSets;

  Impl(const Device& dev, const SceneBuffers& buffers, std::uint32_t w, std::uint32_t h)
      : device(dev), scene(buffers), width(w), height(h),
        tileRows(makeTiles(w, h).front().rows), ids{makeIds(dev, w, tileRows), DeviceImage()},
        depth(makeDepth(dev, w, tileRows)), idsOut(dev, vk::DeviceSize{w} * tileRows * sizeof(glm::uvec2)),
        geometry(geometryBindings(buffers)), geometryLayout(makeSetLayout(dev, geometry, kRasterStages)),
        textureLayout(makeSetLayout(dev, std::vector<Binding>{buffers.textures().bindings({}).front()}, kRasterStages)),
        rasterLayout(
            makePipelineLayout(dev, std::array{*geometryLayout, *textureLayout}, sizeof(RasterPush), kRasterStages)),
        sampler(dev.handle(), vk::SamplerCreateInfo()) {
    plain = makeVisibilityPipeline(device, rasterLayout, Visibility::plain);
    geometrySet = std::make_unique<DescriptorSets>(device, geometryLayout, std::span(&geometry, 1));
    // Only alpha is read here, and only where it decides what is seen.
    std::vector<Textures::Need> needs(scene.textures().setCount());
    for (std::uint32_t set = 0; set < needs.size(); ++set) needs[set].set = set;
    bool anyMasked = false;
    for (const std::uint32_t m : scene.materialOfInstance()) {
      const scenes::AlphaMode mode = scene.scene().materials[m].alphaMode;
      if (mode == scenes::AlphaMode::opaque) continue;
      needs[scene.textures().setOfMaterial()[m]].slots = 1u << kSlotBaseColor;
      anyMasked |= mode == scenes::AlphaMode::mask;
      blended |= mode == scenes::AlphaMode::blend;
    }
    scene.textures().require(needs);
    std::vector<std::vector<Binding>> sets;
    for (const Textures::Need& need : needs) sets.push_back({scene.textures().bindings(need).front()});
    textureSets = std::make_unique<DescriptorSets>(device, textureLayout, sets);
    if (anyMasked) masked = makeVisibilityPipeline(device, rasterLayout, Visibility::masked);
    if (blended) preparePeeling();
  }

  void preparePeeling() {
    ids[1] = makeIds(device, width, tileRows);
    for (DeviceImage& image : peeledDepth) image = makeDepth(device, width, tileRows);
    std::vector<std::vector<Binding>> sets;
    for (const std::size_t before : {1, 0}) {
      std::vector<Binding>& bindings = sets.emplace_back();
      for (const DeviceImage* image : {&depth, &peeledDepth[before], &ids[before]})
        bindings.push_back(vk::DescriptorImageInfo(*sampler, image->view(), kReadOnlyLayout));
    }
    peelSetLayout = makeSetLayout(device, sets.front(), kRasterStages);
    peelSets = std::make_unique<DescriptorSets>(device, peelSetLayout, sets);
    peelLayout = makePipelineLayout(device, std::array{*geometryLayout, *textureLayout, *peelSetLayout},
                                    sizeof(RasterPush), kRasterStages);
    peeling = makeVisibilityPipeline(device, peelLayout, Visibility::peeled);
  }

  void draw(const vk::raii::CommandBuffer& commands, const Part& part, const DeviceImage& toIds,
            const DeviceImage& toDepth, std::optional<std::uint32_t> layer, bool withoutTransmissive = false) const;
  void drawInstances(const vk::raii::CommandBuffer& commands, const glm::mat4& worldToClip,
                     std::optional<std::uint32_t> layer, bool withoutTransmissive) const;
  void copyOut(const vk::raii::CommandBuffer& commands, const DeviceImage& from, std::uint32_t rows) const;
};

// layer: of blended surfaces; none: the opaque ones.
void VisibilityPass::Impl::drawInstances(const vk::raii::CommandBuffer& commands, const glm::mat4& worldToClip,
                                         std::optional<std::uint32_t> layer, bool withoutTransmissive) const {
  const scenes::Scene& s = scene.scene();
  const vk::PipelineLayout layout = layer ? *peelLayout : *rasterLayout;
  commands.bindIndexBuffer(scene.indices.handle(), 0, vk::IndexType::eUint32);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 0, (*geometrySet)[0], {});
  if (layer) commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 2, (*peelSets)[*layer % 2], {});
  for (std::uint32_t i = 0; i < s.instances.size(); ++i) {
    const scenes::Instance& instance = s.instances[i];
    const std::uint32_t materialIndex = scene.materialOfInstance()[i];
    const scenes::Material& material = s.materials[materialIndex];
    if ((material.alphaMode == scenes::AlphaMode::blend) != layer.has_value()) continue;
    if (withoutTransmissive && material.hasTransmission()) continue;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, layer                                           ? *peeling
                                                            : material.alphaMode == scenes::AlphaMode::mask ? *masked
                                                                                                            : *plain);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, layout, 1,
                                (*textureSets)[scene.textures().setOfMaterial()[materialIndex]], {});
    commands.setCullMode(material.doubleSided ? vk::CullModeFlagBits::eNone : vk::CullModeFlagBits::eBack);
    commands.setFrontFace(glm::determinant(glm::mat3(instance.toWorld)) < 0 ? vk::FrontFace::eClockwise
                                                                            : vk::FrontFace::eCounterClockwise);
    commands.pushConstants<RasterPush>(
        layout, kRasterStages, 0, RasterPush{worldToClip * instance.toWorld, i, scene.vertexData(), layer.value_or(0)});
    const SceneBuffers::MeshRange& range = scene.meshes()[instance.mesh];
    commands.drawIndexed(range.indexCount, 1, range.firstIndex, static_cast<std::int32_t>(range.baseVertex), 0);
  }
}

void VisibilityPass::Impl::draw(const vk::raii::CommandBuffer& commands, const Part& part, const DeviceImage& toIds,
                                const DeviceImage& toDepth, std::optional<std::uint32_t> layer,
                                bool withoutTransmissive) const {
  const auto w = static_cast<float>(width), h = static_cast<float>(height);
  changeLayout(commands, toIds, vk::ImageLayout::eUndefined, kColor);
  changeLayout(commands, toDepth, vk::ImageLayout::eUndefined, kDepthLayout);
  constexpr auto kClear = vk::AttachmentLoadOp::eClear;
  constexpr auto kStore = vk::AttachmentStoreOp::eStore;
  const vk::RenderingAttachmentInfo color(toIds.view(), kColor, {}, {}, {}, kClear, kStore,
                                          vk::ClearColorValue(std::array<std::uint32_t, 4>{}));
  const vk::RenderingAttachmentInfo depthInfo(toDepth.view(), kDepthLayout, {}, {}, {}, kClear, kStore,
                                              vk::ClearDepthStencilValue(1.f, 0));
  const vk::Rect2D area({0, 0}, {width, part.tile.rows});
  commands.beginRendering(vk::RenderingInfo({}, area, 1, 0, color, &depthInfo));
  // The whole picture's viewport, moved so that the tile's first row comes first and the sample lies at the pixel
  // centre.
  const float x = 0.5f - part.sample.x, y = 0.5f - part.sample.y - static_cast<float>(part.tile.firstRow);
  commands.setViewport(0, vk::Viewport(x, y + h, w, -h, 0, 1));
  commands.setScissor(0, area);
  drawInstances(commands, makeWorldToClip(part.camera, w / h), layer, withoutTransmissive);
  commands.endRendering();
}

void VisibilityPass::Impl::copyOut(const vk::raii::CommandBuffer& commands, const DeviceImage& from,
                                   std::uint32_t rows) const {
  changeLayout(commands, from, kColor, vk::ImageLayout::eTransferSrcOptimal);
  commands.copyImageToBuffer(
      from.handle(), vk::ImageLayout::eTransferSrcOptimal, idsOut.handle(),
      vk::BufferImageCopy(0, 0, 0, {vk::ImageAspectFlagBits::eColor, 0, 0, 1}, {}, {width, rows, 1}));
}

VisibilityPass::VisibilityPass(const Device& device, const SceneBuffers& scene, std::uint32_t width,
                               std::uint32_t height)
    : m_impl(std::make_unique<Impl>(device, scene, width, height)) {}
VisibilityPass::~VisibilityPass() = default;
bool VisibilityPass::hasBlended() const { return m_impl->blended; }

VisibilityPass::Ids VisibilityPass::renderOpaque(const Part& part, bool withoutTransmissive) const {
  const Impl& impl = *m_impl;
  impl.device.submit("surface raster", [&](const vk::raii::CommandBuffer& commands) {
    impl.draw(commands, part, impl.ids[0], impl.depth, std::nullopt, withoutTransmissive);
    impl.copyOut(commands, impl.ids[0], part.tile.rows);
    if (impl.blended) changeLayout(commands, impl.depth, kDepthLayout, kReadOnlyLayout);
  });
  return impl.idsOut.downloadAs<glm::uvec2>(std::size_t{impl.width} * part.tile.rows);
}

VisibilityPass::Ids VisibilityPass::peel(const Part& part, std::uint32_t layer) const {
  const Impl& impl = *m_impl;
  const std::size_t to = layer % 2, before = 1 - to;
  impl.device.submit("surface peel", [&](const vk::raii::CommandBuffer& commands) {
    if (layer == 0) { // it is bound, but not read
      changeLayout(commands, impl.ids[before], vk::ImageLayout::eUndefined, kReadOnlyLayout);
      changeLayout(commands, impl.peeledDepth[before], vk::ImageLayout::eUndefined, kReadOnlyLayout);
    }
    impl.draw(commands, part, impl.ids[to], impl.peeledDepth[to], layer);
    impl.copyOut(commands, impl.ids[to], part.tile.rows);
    changeLayout(commands, impl.ids[to], vk::ImageLayout::eTransferSrcOptimal, kReadOnlyLayout);
    changeLayout(commands, impl.peeledDepth[to], kDepthLayout, kReadOnlyLayout);
  });
  return impl.idsOut.downloadAs<glm::uvec2>(std::size_t{impl.width} * part.tile.rows);
}

} // namespace parity::gpu
