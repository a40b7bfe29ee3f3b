// A scene on the device: geometry, instances, materials and textures, uploaded once and read by every path.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gpu/device/buffer.h"
#include "gpu/shaders/interface.h"
#include "gpu/surface/material_class.h"
#include "gpu/surface/textures.h"
#include "scenes/gltf/lightmap_uvs.h"
#include "scenes/scene.h"
#include "shading/terms.h"

namespace parity::gpu {

class SceneBuffers {
public:
  // Throws Error (exit 4) where an attribute array exceeds what the device can bind (128 MiB on many).
  // onLastRead: see Textures. lightmap: where each instance lies in the pages, read here only; null: none is baked.
  SceneBuffers(const Device& device, const scenes::Scene& scene, SpecularAa specularAa = SpecularAa::off,
               ImageDone onLastRead = {}, const scenes::LightmapUvs* lightmap = nullptr);

  const scenes::Scene& scene() const { return m_scene; }
  const Textures& textures() const { return m_textures; }
  const std::vector<MaterialClass>& classOfMaterial() const { return m_classOfMaterial; }
  // Material of each instance (that of its mesh).
  const std::vector<std::uint32_t>& materialOfInstance() const { return m_materialOfInstance; }
  SpecularAa specularAa() const { return m_specularAa; }
  // kVertex... bits of interface.h: what some mesh has, whether there is fog, whether some object has a lightmap.
  std::uint32_t vertexData() const { return m_vertexData; }
  // All bits of a texture mask that a scene of these settings may have.
  std::uint32_t textureBits() const { return m_textureBits; }
  // Planes of terms that a path writes of it: those after fog only where a material has lobes beside the base's own.
  std::size_t termCount() const { return hasLobes() ? shading::kTermCount : shading::kBaseTermCount; }
  // Lobes that the materials of its meshes have (lobesOf).
  std::uint32_t lobes() const { return m_lobes; }
  bool hasLobes() const { return m_lobes != 0; }
  // First index and base vertex of each mesh in the shared buffers.
  struct MeshRange {
    std::uint32_t firstIndex = 0, indexCount = 0, baseVertex = 0;
  };
  const std::vector<MeshRange>& meshes() const { return m_meshes; }

  // Puts other numbers in a material's place, for all who shade afterwards: of the same textures and the same class.
  void setFactors(std::size_t index, const scenes::Material& material) const;

  // A copy of `materials` as they are now, without these features (kFeature... bits). setFactors does not reach it.
  Buffer materialsWithout(const Device& device, std::uint32_t features) const;

  Buffer positions, normals, tangents, uvs, colors, indices, instances, materials, lightmapCorners;

private:
  void uploadGeometry(const Device& device);

  const scenes::Scene& m_scene;
  Textures m_textures;
  std::vector<MaterialClass> m_classOfMaterial;
  std::vector<std::uint32_t> m_materialOfInstance;
  std::vector<MeshRange> m_meshes;
  SpecularAa m_specularAa;
  std::uint32_t m_vertexData = 0, m_textureBits = 0;
  std::uint32_t m_lobes = 0;
};

} // namespace parity::gpu
