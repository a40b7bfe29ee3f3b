#include "gpu/surface/scene_buffers.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <span>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "scenes/texture_slots.h"

namespace parity::gpu {

namespace {

constexpr std::uint32_t kNormalMaps = 1u << kSlotNormal | 1u << kSlotCoatNormal;

GpuMaterial pack(const scenes::Material& m) {
  scenes::Material withoutFactor = m;
  withoutFactor.specular = 1;
  GpuMaterial out;
  out.baseColor = m.baseColor;
  out.emissiveMetallic = vec4(m.emissive, m.metallic);
  out.f0Roughness = vec4(withoutFactor.dielectricF0(), m.roughness);
  const float cutoff = m.alphaMode == scenes::AlphaMode::mask ? m.alphaCutoff : 1.f / 255;
  out.factors = vec4(m.normalScale, m.occlusionStrength, m.specular, cutoff);
  out.coat = vec4(m.coat, m.coatRoughness, m.coatNormalScale, 0);
  out.sheen = vec4(m.sheenColor, m.sheenRoughness);
  out.anisotropy = vec4(m.anisotropy, std::cos(m.anisotropyRotation), std::sin(m.anisotropyRotation), 0);
  out.film = vec4(m.iridescence, m.iridescenceIor, m.iridescenceThicknessMin, m.iridescenceThicknessMax);
  out.through = vec4(m.transmission, std::max(m.ior, 1.f), m.thickness, m.diffuseTransmission);
  out.absorption = vec4(m.absorption(), m.dispersion);
  out.diffuseThrough = vec4(m.diffuseTransmissionColor, 0);
  out.flags = uvec4(classify(m).features, 0, 0, 0);
  for (int slot = 0; slot < kSlotCount; ++slot) {
    const scenes::TextureSlot& texture = *slotsOf(m)[slot];
    const auto& t = texture.uvTransform;
    out.slots[slot].uvRow0 = vec4(t[0], t[1], t[2], static_cast<float>(texture.texCoord));
    out.slots[slot].uvRow1 = vec4(t[3], t[4], t[5], texture.present() ? 1.f : 0.f);
  }
  return out;
}

GpuInstance pack(const scenes::Instance& instance, const SceneBuffers::MeshRange& range, std::uint32_t material,
                 const scenes::LightmapUvs::Place& place) {
  const glm::mat4 rows = glm::transpose(instance.toWorld);
  const glm::mat3 linear(instance.toWorld);
  const float determinant = glm::determinant(linear);
  // The cofactor matrix is the inverse transpose times the determinant: defined for flattened objects too, and scale
  // does not matter.
  const glm::mat3 cofactors(glm::cross(linear[1], linear[2]), glm::cross(linear[2], linear[0]),
                            glm::cross(linear[0], linear[1]));
  const float sign = determinant < 0 ? -1.f : 1.f;
  float largest = 0;
  for (int c = 0; c < 3; ++c)
    for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(cofactors[c][r]));
  const glm::mat3 normalRows = glm::transpose(cofactors) * (largest > 0 ? sign / largest : 0.f);
  GpuInstance out;
  for (int r = 0; r < 3; ++r) {
    out.toWorld[r] = rows[r];
    out.normalToWorld[r] = vec4(normalRows[r], 0);
  }
  out.normalToWorld[0].w = sign;
  out.geometry = uvec4(range.firstIndex, range.baseVertex, material, 0);
  out.baked = uvec4(place.firstCorner, place.page + 1, place.capture, 0);
  out.lightmap = vec4(place.offset, 0, 0);
  return out;
}

// A buffer that is filled from its begin on, by parts: of what is uploaded no second copy is in memory as a whole.
template <typename T> class Filling {
public:
  // what: for errors. Throws Error (exit 4) where the device cannot bind so much.
  Filling(const Device& device, std::size_t count, const scenes::Scene& scene, const char* what) {
    const std::size_t bytes = count * sizeof(T), limit = device.properties().limits.maxStorageBufferRange;
    if (bytes > limit)
      throw base::fileError(scene.name, what,
                            fmt::format("{} MiB of geometry; the device '{}' can bind at most {} MiB", bytes >> 20,
                                        device.report().name, limit >> 20));
    m_buffer = Buffer(device, bytes);
    m_most = (device.unifiedMemory() ? kMappedPart : kStagedPart) / sizeof(T);
    m_part.reserve(std::min(count, m_most));
  }

  void append(const T& value) {
    m_part.push_back(value);
    if (m_part.size() == m_most) upload();
  }
  void append(std::span<const T> values) {
    while (!values.empty()) {
      const std::span<const T> some = values.first(std::min(m_most - m_part.size(), values.size()));
      m_part.insert(m_part.end(), some.begin(), some.end());
      if (m_part.size() == m_most) upload();
      values = values.subspan(some.size());
    }
  }
  // An attribute of `count` vertices, or a default where the mesh lacks it.
  void append(std::span<const T> values, std::size_t count, const T& missing) {
    append(values);
    if (values.empty())
      for (std::size_t i = 0; i < count; ++i) append(missing);
  }

  Buffer take() {
    upload();
    return std::move(m_buffer);
  }

private:
  static constexpr std::size_t kMappedPart = 1 << 20, kStagedPart = 16 << 20; // bytes; a staged one is a submission

  void upload() {
    m_buffer.upload(std::as_bytes(std::span{m_part}), m_done * sizeof(T));
    m_done += m_part.size();
    m_part.clear();
  }

  Buffer m_buffer;
  std::vector<T> m_part;
  std::size_t m_most = 0, m_done = 0; // elements of a part, elements uploaded
};

template <typename T>
Buffer makeBuffer(const Device& device, std::span<const T> content, const scenes::Scene& scene, const char* what) {
  Filling<T> filling(device, content.size(), scene, what);
  filling.append(content);
  return filling.take();
}

} // namespace

static_assert(scenes::kTextureSlots.size() == kSlotCount, "in the order of kSlot...");

std::array<const scenes::TextureSlot*, kSlotCount> slotsOf(const scenes::Material& m) {
  std::array<const scenes::TextureSlot*, kSlotCount> slots{};
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i] = &(m.*scenes::kTextureSlots[i].slot);
  return slots;
}

std::uint32_t lobesOf(const scenes::Material& m) {
  return (m.hasCoat() ? kFeatureCoat : 0u) | (m.hasSheen() ? kFeatureSheen : 0u) |
         (m.hasAnisotropy() ? kFeatureAnisotropy : 0u) | (m.hasIridescence() ? kFeatureIridescence : 0u) |
         (m.hasTransmission() ? kFeatureTransmission : 0u) |
         (m.hasDiffuseTransmission() ? kFeatureDiffuseTransmission : 0u);
}

namespace {

bool transformsUvs(const scenes::TextureSlot& texture) {
  return texture.texCoord != 0 || texture.uvTransform != scenes::TextureSlot().uvTransform;
}

} // namespace

MaterialClass classify(const scenes::Material& material) {
  MaterialClass result;
  if (material.unlit) {
    // Unlit: base colour and nothing else is read.
    result.features = kFeatureUnlit;
    if (material.baseColorTexture.present()) result.textures = 1u << kSlotBaseColor;
  } else {
    for (int slot = 0; slot < kSlotCount; ++slot)
      if (slotsOf(material)[slot]->present()) result.textures |= 1u << slot;
    const std::uint32_t lobes = lobesOf(material);
    result.features |= lobes;
    if ((lobes & kFeatureCoat) == 0) result.textures &= ~kCoatTextures;
    if ((lobes & kFeatureSheen) == 0) result.textures &= ~kSheenTextures;
    if ((lobes & kFeatureAnisotropy) == 0) result.textures &= ~kAnisotropyTextures;
    if ((lobes & kFeatureIridescence) == 0) result.textures &= ~kIridescenceTextures;
    if ((lobes & kFeatureTransmission) == 0) result.textures &= ~kTransmissionTextures;
    if ((lobes & kFeatureDiffuseTransmission) == 0) result.textures &= ~kDiffuseTransmissionTextures;
    if (material.hasVolume())
      result.features |= kFeatureVolume;
    else
      result.textures &= ~kThicknessTextures;
    if (material.isNonmetal()) result.features |= kFeatureNonmetal;
    if (material.fullyRough) result.features |= kFeatureFullyRough;
  }
  if (material.alphaMode == scenes::AlphaMode::blend) result.features |= kFeatureBlend;
  for (int slot = 0; slot < kSlotCount; ++slot)
    if ((result.textures >> slot & 1u) != 0 && transformsUvs(*slotsOf(material)[slot]))
      result.textures |= kTransformedUvs;
  constexpr std::uint32_t kOcclusion = 1u << kSlotOcclusion;
  if ((result.textures & kOcclusion) != 0 && material.occlusionTexture != material.metallicRoughnessTexture)
    result.textures |= kOcclusionApart;
  return result;
}

namespace {

// Materials that differ by kTextureReads alone are of one class: those bits are worth no shader of their own.
void joinClasses(std::vector<MaterialClass>& classes) {
  const auto plainOf = [](const MaterialClass& c) { return MaterialClass{c.textures & ~kTextureReads, c.features}; };
  std::map<MaterialClass, std::uint32_t> reads;
  for (const MaterialClass& each : classes) reads[plainOf(each)] |= each.textures & kTextureReads;
  for (MaterialClass& each : classes) each.textures |= reads[plainOf(each)];
}

} // namespace

SceneBuffers::SceneBuffers(const Device& device, const scenes::Scene& scene, SpecularAa specularAa,
                           ImageDone onLastRead, const scenes::LightmapUvs* lightmap)
    : m_scene(scene), m_textures(device, scene, specularAa == SpecularAa::toksvig, std::move(onLastRead)),
      m_specularAa(specularAa) {
  for (const scenes::Mesh& mesh : scene.meshes) m_lobes |= lobesOf(scene.materials[mesh.material]);
  bool anyColors = false, anyUvs = false, anyTangents = false, anySecondUv = false;
  for (const scenes::Mesh& mesh : scene.meshes) {
    anyColors |= !mesh.colors.empty();
    anyUvs |= !mesh.uv0.empty() || !mesh.uv1.empty();
    anyTangents |= !mesh.tangents.empty();
  }
  m_textureBits = (((1u << kSlotCount) - 1) & (hasLobes() ? ~0u : ~kLobeTextures)) | kTextureReads |
                  (specularAa == SpecularAa::toksvig ? kNormalVariance : 0u);
  std::vector<GpuMaterial> gpuMaterials;
  for (const scenes::Material& material : scene.materials) {
    MaterialClass& materialClass = m_classOfMaterial.emplace_back(classify(material));
    if (specularAa == SpecularAa::toksvig && (materialClass.textures & kNormalMaps) != 0)
      materialClass.textures |= kNormalVariance;
    gpuMaterials.push_back(pack(material));
    for (int slot = 0; slot < kSlotCount; ++slot)
      anySecondUv |= slotsOf(material)[slot]->present() && slotsOf(material)[slot]->texCoord == 1;
  }
  joinClasses(m_classOfMaterial);
  m_vertexData = (anyColors ? kVertexColors : 0u) | (anyUvs ? kVertexUvs : 0u) | (anyTangents ? kVertexTangents : 0u) |
                 (anySecondUv ? kVertexSecondUv : 0u) | (scene.fog ? kVertexFog : 0u);

  uploadGeometry(device);
  assert(!lightmap || lightmap->places.size() == scene.instances.size());
  std::vector<GpuInstance> gpuInstances;
  for (std::size_t i = 0; i < scene.instances.size(); ++i) {
    const scenes::Instance& instance = scene.instances[i];
    const std::uint32_t material = scene.meshes[instance.mesh].material;
    const scenes::LightmapUvs::Place place = lightmap ? lightmap->places[i] : scenes::LightmapUvs::Place();
    assert(place.page < 0 || place.firstCorner + m_meshes[instance.mesh].indexCount <= lightmap->corners.size());
    if (place.page >= 0) m_vertexData |= kVertexLightmap;
    m_materialOfInstance.push_back(material);
    gpuInstances.push_back(pack(instance, m_meshes[instance.mesh], material, place));
  }
  instances = makeBuffer(device, std::span<const GpuInstance>(gpuInstances), scene, "instances");
  materials = makeBuffer(device, std::span<const GpuMaterial>(gpuMaterials), scene, "materials");
  lightmapCorners =
      makeBuffer(device, lightmap ? std::span<const glm::vec2>(lightmap->corners) : std::span<const glm::vec2>(), scene,
                 "lightmap uvs");
}

void SceneBuffers::uploadGeometry(const Device& device) {
  std::size_t vertexCount = 0, indexCount = 0;
  for (const scenes::Mesh& mesh : m_scene.meshes) {
    m_meshes.push_back({static_cast<std::uint32_t>(indexCount), static_cast<std::uint32_t>(mesh.indices.size()),
                        static_cast<std::uint32_t>(vertexCount)});
    vertexCount += mesh.positions.size();
    indexCount += mesh.indices.size();
  }
  const auto countIf = [&](std::uint32_t bit) { return (m_vertexData & bit) != 0 ? vertexCount : 0; };
  // One attribute after another: a part of each waits at a time.
  const auto fill = [&]<typename T>(std::size_t count, const char* what, const T& missing, const auto& valuesOf) {
    Filling<T> filling(device, count, m_scene, what);
    if (count > 0)
      for (const scenes::Mesh& mesh : m_scene.meshes)
        filling.append(std::span<const T>(valuesOf(mesh)), mesh.positions.size(), missing);
    return filling.take();
  };
  positions = fill(
      vertexCount, "positions", glm::vec3(0), [](const auto& m) -> auto& { return m.positions; });
  normals = fill(
      vertexCount, "normals", glm::vec3(0), [](const auto& m) -> auto& { return m.normals; });
  tangents = fill(
      countIf(kVertexTangents), "tangents", glm::vec4(0), [](const auto& m) -> auto& { return m.tangents; });
  colors = fill(
      countIf(kVertexColors), "colours", glm::vec4(1), [](const auto& m) -> auto& { return m.colors; });

  Filling<glm::vec4> bothUvs(device, countIf(kVertexUvs), m_scene, "uvs");
  if ((m_vertexData & kVertexUvs) != 0)
    for (const scenes::Mesh& mesh : m_scene.meshes)
      for (std::size_t i = 0; i < mesh.positions.size(); ++i)
        bothUvs.append(
            glm::vec4(mesh.uv0.empty() ? glm::vec2(0) : mesh.uv0[i], mesh.uv1.empty() ? glm::vec2(0) : mesh.uv1[i]));
  uvs = bothUvs.take();
  Filling<std::uint32_t> allIndices(device, indexCount, m_scene, "indices");
  for (const scenes::Mesh& mesh : m_scene.meshes) allIndices.append(mesh.indices);
  indices = allIndices.take();
}

void SceneBuffers::setFactors(std::size_t index, const scenes::Material& material) const {
  assert(classify(material) == classify(m_scene.materials[index]));
  const GpuMaterial packed = pack(material);
  materials.upload(std::as_bytes(std::span(&packed, 1)), index * sizeof(packed));
}

Buffer SceneBuffers::materialsWithout(const Device& device, std::uint32_t features) const {
  std::vector<GpuMaterial> all = materials.downloadAs<GpuMaterial>(m_scene.materials.size());
  for (GpuMaterial& material : all) material.flags.x &= ~features;
  return makeBuffer(device, std::span<const GpuMaterial>(all), m_scene, "materials");
}

} // namespace parity::gpu
