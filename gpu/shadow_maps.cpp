#include "gpu/shadow_maps.h"

#include <cmath>

#include <fmt/format.h>

#include "gpu/graphics_pipeline.h"
#include "gpu/shadow_tiles.h"

namespace parity::gpu {

namespace {

constexpr auto kDepth = vk::ImageLayout::eDepthStencilAttachmentOptimal;
constexpr auto kReadOnly = vk::ImageLayout::eShaderReadOnlyOptimal;

struct RasterPush { // of visibility.vert
  glm::mat4 toClip;
  std::uint32_t instance = 0, vertexData = 0, layer = 0;
};

GpuShadowView pack(const ShadowView& view, const ShadowTile& tile, float layerSide, std::uint32_t filter) {
  GpuShadowView out{};
  const float half = 0.5f * static_cast<float>(view.side);
  if (view.side > 0) {
    out.right = vec4(view.right, half / shadowExtent(view, filter));
    out.up = vec4(view.up, static_cast<float>(tile.layer));
    out.forward = vec4(view.forward, view.orthographic ? -1 / (view.far - view.near) : view.near);
    out.origin = vec4(view.origin, view.bias);
  }
  out.tile = vec4(static_cast<float>(tile.x) + half, static_cast<float>(tile.y) + half, half, 1 / layerSide);
  return out;
}

// Depth is 1 at the near plane and falls: near / distance, or linearly to 0 at the far plane; orthographic ones begin
// at 0. In double: what cancels of a scene far from its origin is gone before it is rounded.
glm::dmat4 worldToClip(const ShadowView& view, std::uint32_t filter) {
  const double scale = 1 / static_cast<double>(shadowExtent(view, filter)), near = view.near;
  const glm::dvec3 origin(view.origin);
  const auto along = [&](const glm::vec3& axis, double times) {
    const glm::dvec3 a = times * glm::dvec3(axis);
    return glm::dvec4(a, -glm::dot(a, origin));
  };
  const glm::dvec4 x = along(view.right, scale), y = along(view.up, scale), distance = along(view.forward, 1);
  const double slope = 1 / static_cast<double>(view.far - view.near);
  const glm::dvec4 z = view.orthographic ? glm::dvec4(0, 0, 0, 1) - slope * distance : glm::dvec4(0, 0, 0, near);
  const glm::dvec4 w = view.orthographic ? glm::dvec4(0, 0, 0, 1) : distance;
  return glm::transpose(glm::dmat4(x, y, z, w));
}

// Pipelines and sets for the casters of a scene.
class CasterPass {
public:
  CasterPass(const Device& device, const SceneBuffers& scene)
      : m_scene(scene), m_geometry{storage(scene.positions), storage(scene.normals),  storage(scene.tangents),
                                   storage(scene.uvs),       storage(scene.colors),   storage(scene.indices),
                                   storage(scene.instances), storage(scene.materials)},
        m_geometryLayout(makeSetLayout(device, m_geometry, kRasterStages)),
        m_textureLayout(
            makeSetLayout(device, std::vector<Binding>{scene.textures().bindings({}).front()}, kRasterStages)),
        m_layout(makePipelineLayout(device, std::array{*m_geometryLayout, *m_textureLayout}, sizeof(RasterPush),
                                    kRasterStages)),
        m_plain(makeVisibilityPipeline(device, m_layout, Visibility::caster)),
        m_geometrySet(device, m_geometryLayout, std::span(&m_geometry, 1)) {
    // Only the alpha of masked casters is read.
    std::vector<Textures::Need> needs(scene.textures().setCount());
    for (std::uint32_t set = 0; set < needs.size(); ++set) needs[set].set = set;
    bool anyMasked = false;
    for (const std::uint32_t m : scene.materialOfInstance())
      if (scene.scene().materials[m].alphaMode == scenes::AlphaMode::mask) {
        needs[scene.textures().setOfMaterial()[m]].slots = 1u << kSlotBaseColor;
        anyMasked = true;
      }
    scene.textures().require(needs);
    std::vector<std::vector<Binding>> sets;
    for (const Textures::Need& need : needs) sets.push_back({scene.textures().bindings(need).front()});
    m_textureSets = std::make_unique<DescriptorSets>(device, m_textureLayout, sets);
    if (anyMasked) m_masked = makeVisibilityPipeline(device, m_layout, Visibility::maskedCaster);
  }

  void begin(const vk::raii::CommandBuffer& commands) const {
    commands.bindIndexBuffer(m_scene.indices.handle(), 0, vk::IndexType::eUint32);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *m_layout, 0, m_geometrySet[0], {});
    commands.setCullMode(vk::CullModeFlagBits::eNone); // light is stopped from both sides
    commands.setFrontFace(vk::FrontFace::eCounterClockwise);
  }

  void draw(const vk::raii::CommandBuffer& commands, const glm::dmat4& toClip, std::uint32_t i) const {
    const scenes::Instance& instance = m_scene.scene().instances[i];
    const std::uint32_t m = m_scene.materialOfInstance()[i];
    const bool isMasked = m_scene.scene().materials[m].alphaMode == scenes::AlphaMode::mask;
    commands.bindPipeline(vk::PipelineBindPoint::eGraphics, isMasked ? *m_masked : *m_plain);
    commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *m_layout, 1,
                                (*m_textureSets)[m_scene.textures().setOfMaterial()[m]], {});
    commands.pushConstants<RasterPush>(
        *m_layout, kRasterStages, 0,
        RasterPush{glm::mat4(toClip * glm::dmat4(instance.toWorld)), i, m_scene.vertexData()});
    const SceneBuffers::MeshRange& range = m_scene.meshes()[instance.mesh];
    commands.drawIndexed(range.indexCount, 1, range.firstIndex, static_cast<std::int32_t>(range.baseVertex), 0);
  }

private:
  const SceneBuffers& m_scene;
  std::vector<Binding> m_geometry;
  vk::raii::DescriptorSetLayout m_geometryLayout, m_textureLayout;
  vk::raii::PipelineLayout m_layout;
  vk::raii::Pipeline m_plain, m_masked{nullptr};
  DescriptorSets m_geometrySet;
  std::unique_ptr<DescriptorSets> m_textureSets;
};

} // namespace

ShadowMaps::ShadowMaps(const Device& device, const SceneBuffers& scene, const std::vector<scenes::Light>& lights,
                       const ShadowOptions& options)
    : m_options(options) {
  const ShadowPlan plan = planShadows(scene.scene(), lights, options);
  for (std::size_t k = 0; k < lights.size(); ++k) {
    if (plan.lights[k].count == 0) continue; // a dark one may stand where another shines
    m_ofLight[shadowKey(lights[k])] = plan.lights[k];
    ++m_lightCount;
  }
  if (plan.shrunk)
    m_note =
        fmt::format("shadow maps are smaller than asked for: all together take {} MiB at most", options.maxBytes >> 20);
  std::vector<std::uint32_t> sides;
  for (const ShadowView& view : plan.views) sides.push_back(view.side);
  const auto& limits = device.properties().limits;
  const ShadowTiling tiling =
      packTiles(sides, limits.maxImageDimension2D, limits.maxImageArrayLayers, device.report().name);
  m_image = DeviceImage(device,
                        {.format = vk::Format::eD32Sfloat,
                         .width = tiling.side,
                         .height = tiling.side,
                         .array = true,
                         .arraySize = tiling.layers,
                         .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled});
  vk::SamplerCreateInfo samplerInfo; // nearest: what is gathered are four texels
  samplerInfo.addressModeU = samplerInfo.addressModeV = vk::SamplerAddressMode::eClampToEdge;
  m_sampler = vk::raii::Sampler(device.handle(), samplerInfo);
  std::vector<GpuShadowView> packed;
  for (std::size_t k = 0; k < plan.views.size(); ++k)
    packed.push_back(pack(plan.views[k], tiling.tiles[k], static_cast<float>(tiling.side), options.filter));
  m_views = Buffer(device, std::span<const GpuShadowView>(packed));

  std::vector<std::vector<std::size_t>> viewsOfLayer(tiling.layers);
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (sides[k] > 0) viewsOfLayer[tiling.tiles[k].layer].push_back(k);
  const CasterPass pass(device, scene);
  for (std::uint32_t layer = 0; layer < tiling.layers; ++layer) {
    const vk::raii::ImageView target = m_image.layerView(device, layer);
    device.submit("shadow maps", [&](const vk::raii::CommandBuffer& commands) {
      if (layer == 0) changeLayout(commands, m_image, vk::ImageLayout::eUndefined, kDepth);
      const vk::RenderingAttachmentInfo depth(*target, kDepth, {}, {}, {}, vk::AttachmentLoadOp::eClear,
                                              vk::AttachmentStoreOp::eStore, vk::ClearDepthStencilValue(0.f, 0));
      commands.beginRendering(
          vk::RenderingInfo({}, vk::Rect2D({0, 0}, {tiling.side, tiling.side}), 1, 0, 0, nullptr, &depth));
      pass.begin(commands);
      for (const std::size_t k : viewsOfLayer[layer]) {
        const ShadowTile& tile = tiling.tiles[k];
        const auto side = static_cast<float>(sides[k]);
        commands.setViewport(0, vk::Viewport(static_cast<float>(tile.x), static_cast<float>(tile.y), side, side, 0, 1));
        commands.setScissor(0, vk::Rect2D({static_cast<std::int32_t>(tile.x), static_cast<std::int32_t>(tile.y)},
                                          {sides[k], sides[k]}));
        const glm::dmat4 toClip = worldToClip(plan.views[k], options.filter);
        for (const std::uint32_t i : plan.views[k].casters) pass.draw(commands, toClip, i);
        m_drawCount += plan.views[k].casters.size();
        ++m_mapCount;
      }
      commands.endRendering();
      if (layer + 1 == tiling.layers) changeLayout(commands, m_image, kDepth, kReadOnly);
    });
  }
}

ShadowOfLight ShadowMaps::of(const scenes::Light& light) const {
  const auto found = m_ofLight.find(shadowKey(light));
  return found == m_ofLight.end() ? ShadowOfLight() : found->second;
}

vk::DescriptorImageInfo ShadowMaps::image() const { return {*m_sampler, m_image.view(), kReadOnly}; }

} // namespace parity::gpu
