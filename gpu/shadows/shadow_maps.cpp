#include "gpu/shadows/shadow_maps.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace parity::gpu {

namespace {

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

} // namespace

ShadowMaps::ShadowMaps(const Device& device, const SceneBuffers& scene, const std::vector<scenes::Light>& lights,
                       const ShadowOptions& options)
    : m_device(device), m_options(options), m_plan(planShadows(scene.scene(), lights, options)), m_drawn(m_plan.views),
      m_pass(device, scene) {
  for (std::size_t k = 0; k < lights.size(); ++k) {
    if (m_plan.lights[k].count == 0) continue; // a dark one may stand where another shines
    m_ofLight[shadowKey(lights[k])] = m_plan.lights[k];
  }
  std::vector<std::uint32_t> sides;
  for (const ShadowView& view : m_plan.views) sides.push_back(view.side);
  const auto& limits = device.properties().limits;
  m_tiling = packTiles(sides, limits.maxImageDimension2D, limits.maxImageArrayLayers, device.report().name);
  m_image = DeviceImage(device,
                        {.format = vk::Format::eD32Sfloat,
                         .width = m_tiling.side,
                         .height = m_tiling.side,
                         .array = true,
                         .arraySize = m_tiling.layers,
                         .usage = vk::ImageUsageFlagBits::eDepthStencilAttachment | vk::ImageUsageFlagBits::eSampled});
  vk::SamplerCreateInfo samplerInfo; // nearest: what is gathered are four texels
  samplerInfo.addressModeU = samplerInfo.addressModeV = vk::SamplerAddressMode::eClampToEdge;
  m_sampler = vk::raii::Sampler(device.handle(), samplerInfo);
  m_views = Buffer(device, m_plan.views.size() * sizeof(GpuShadowView));
  m_windows.resize(m_plan.views.size());
  std::vector<std::size_t> all;
  for (std::size_t k = 0; k < sides.size(); ++k)
    if (sides[k] > 0) all.push_back(k);
  draw(all, true);
}

void ShadowMaps::draw(const std::vector<std::size_t>& views, bool first) {
  std::vector<GpuShadowView> packed;
  for (std::size_t k = 0; k < m_drawn.size(); ++k)
    packed.push_back(pack(m_drawn[k], m_tiling.tiles[k], static_cast<float>(m_tiling.side), m_options.filter));
  m_views.upload(std::as_bytes(std::span{packed}));
  std::map<std::uint32_t, std::vector<std::size_t>> viewsOfLayer;
  if (first)
    for (std::uint32_t layer = 0; layer < m_tiling.layers; ++layer) viewsOfLayer[layer]; // to be cleared
  for (const std::size_t k : views) viewsOfLayer[m_tiling.tiles[k].layer].push_back(k);
  std::size_t left = viewsOfLayer.size();
  for (const auto& [layer, ofLayer] : viewsOfLayer) {
    const bool isFirst = left == viewsOfLayer.size(), isLast = --left == 0;
    const vk::raii::ImageView target = m_image.layerView(m_device, layer);
    m_device.submit("shadow maps", [&, &ofLayer = ofLayer](const vk::raii::CommandBuffer& commands) {
      if (isFirst) changeLayout(commands, m_image, first ? vk::ImageLayout::eUndefined : kReadOnlyLayout, kDepthLayout);
      const vk::RenderingAttachmentInfo depth(*target, kDepthLayout, {}, {}, {},
                                              first ? vk::AttachmentLoadOp::eClear : vk::AttachmentLoadOp::eLoad,
                                              vk::AttachmentStoreOp::eStore, vk::ClearDepthStencilValue(0.f, 0));
      commands.beginRendering(
          vk::RenderingInfo({}, vk::Rect2D({0, 0}, {m_tiling.side, m_tiling.side}), 1, 0, 0, nullptr, &depth));
      m_pass.begin(commands);
      for (const std::size_t k : ofLayer) drawView(commands, k, !first);
      commands.endRendering();
      if (isLast) changeLayout(commands, m_image, kDepthLayout, kReadOnlyLayout);
    });
  }
}

void ShadowMaps::drawView(const vk::raii::CommandBuffer& commands, std::size_t k, bool clears) {
  const ShadowView& view = m_drawn[k];
  const ShadowTile& tile = m_tiling.tiles[k];
  const auto side = static_cast<float>(view.side);
  const vk::Rect2D area({static_cast<std::int32_t>(tile.x), static_cast<std::int32_t>(tile.y)}, {view.side, view.side});
  if (clears)
    commands.clearAttachments(
        vk::ClearAttachment(vk::ImageAspectFlagBits::eDepth, 0, vk::ClearDepthStencilValue(0.f, 0)),
        vk::ClearRect(area, 0, 1));
  commands.setViewport(0, vk::Viewport(static_cast<float>(tile.x), static_cast<float>(tile.y), side, side, 0, 1));
  commands.setScissor(0, area);
  const glm::dmat4 toClip = worldToClip(view, m_options.filter);
  for (const std::uint32_t i : view.casters) m_pass.draw(commands, toClip, i);
  m_drawCount += view.casters.size();
  ++m_mapCount;
}

void ShadowMaps::fitTo(const Surface& surface) {
  if (std::ranges::none_of(m_plan.views, [](const ShadowView& view) { return view.orthographic && view.side > 0; }))
    return;
  const auto positions = surface.position.downloadAs<glm::vec4>(surface.size()); // w: the instance's bits
  std::vector<std::size_t> changed;
  for (std::size_t k = 0; k < m_plan.views.size(); ++k) {
    const ShadowView& whole = m_plan.views[k];
    if (!whole.orthographic || whole.side == 0) continue;
    if (surface.blended && holds(whole, m_windows[k], positions)) continue;
    const ShadowWindow window = windowAbout(whole, positions);
    if (window == m_windows[k]) continue;
    m_windows[k] = window;
    m_drawn[k] = throughWindow(whole, window, m_plan.casters, m_options.filter);
    changed.push_back(k);
  }
  if (!changed.empty()) draw(changed, false);
}

std::string ShadowMaps::note() const {
  std::uint32_t least = UINT32_MAX;
  for (const ShadowView& view : m_plan.views)
    if (view.side > 0) least = std::min(least, view.side);
  if (!m_plan.shrunk) return "";
  return fmt::format(
      "shadow maps are smaller than requested, down to {0}x{0} texels: the limit for all of them is {1} MiB", least,
      m_options.maxBytes >> 20);
}

ShadowOfLight ShadowMaps::of(const scenes::Light& light) const {
  const auto found = m_ofLight.find(shadowKey(light));
  return found == m_ofLight.end() ? ShadowOfLight() : found->second;
}

vk::DescriptorImageInfo ShadowMaps::image() const { return {*m_sampler, m_image.view(), kReadOnlyLayout}; }

} // namespace parity::gpu
