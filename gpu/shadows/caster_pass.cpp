#include "gpu/shadows/caster_pass.h"

#include <array>

#include "gpu/device/graphics_pipeline.h"

namespace parity::gpu {

CasterPass::CasterPass(const Device& device, const SceneBuffers& scene)
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

void CasterPass::begin(const vk::raii::CommandBuffer& commands) const {
  commands.bindIndexBuffer(m_scene.indices.handle(), 0, vk::IndexType::eUint32);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *m_layout, 0, m_geometrySet[0], {});
  commands.setCullMode(vk::CullModeFlagBits::eNone); // light is stopped from both sides
  commands.setFrontFace(vk::FrontFace::eCounterClockwise);
}

void CasterPass::draw(const vk::raii::CommandBuffer& commands, const glm::dmat4& worldToClip, std::uint32_t i) const {
  const scenes::Instance& instance = m_scene.scene().instances[i];
  const std::uint32_t m = m_scene.materialOfInstance()[i];
  const bool isMasked = m_scene.scene().materials[m].alphaMode == scenes::AlphaMode::mask;
  commands.bindPipeline(vk::PipelineBindPoint::eGraphics, isMasked ? *m_masked : *m_plain);
  commands.bindDescriptorSets(vk::PipelineBindPoint::eGraphics, *m_layout, 1,
                              (*m_textureSets)[m_scene.textures().setOfMaterial()[m]], {});
  commands.pushConstants<RasterPush>(
      *m_layout, kRasterStages, 0,
      RasterPush{glm::mat4(worldToClip * glm::dmat4(instance.toWorld)), i, m_scene.vertexData()});
  const SceneBuffers::MeshRange& range = m_scene.meshes()[instance.mesh];
  commands.drawIndexed(range.indexCount, 1, range.firstIndex, static_cast<std::int32_t>(range.baseVertex), 0);
}

} // namespace parity::gpu
