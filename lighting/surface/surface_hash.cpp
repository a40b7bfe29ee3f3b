#include "lighting/surface/surface_hash.h"

#include <set>
#include <span>
#include <vector>

#include "base/hash.h"
#include "base/member_count.h"

namespace parity::lighting {

namespace {

// Not in the keys: names; tangents, which hashOfSurfaces adds; what decides no light that is baked or bounced: how mips
// are read, the fully rough shortcut, what no path shows; and all lobes beside the base's own, which baked and bounced
// light leave out, but for whether a material lets light past it.
static_assert(base::memberCount<scenes::Mesh>() == 9 && base::memberCount<scenes::Instance>() == 3 &&
                  base::memberCount<scenes::Material>() == 53 && base::memberCount<scenes::TextureSlot>() == 4 &&
                  base::memberCount<scenes::Sampler>() == 6,
              "a new member goes into the key, or is named here with the reason why not");

template <typename T> void addAll(base::Hasher& hasher, const std::vector<T>& list) {
  hasher.addValue(list.size()).add(std::as_bytes(std::span{list}));
}

} // namespace

std::string hashOfGeometry(const scenes::Scene& scene) {
  base::Hasher hasher;
  hasher.addValue(scene.meshes.size()).addValue(scene.instances.size());
  for (const scenes::Mesh& mesh : scene.meshes) {
    addAll(hasher, mesh.positions);
    addAll(hasher, mesh.normals);
    addAll(hasher, mesh.uv0);
    addAll(hasher, mesh.uv1);
    addAll(hasher, mesh.colors);
    addAll(hasher, mesh.indices);
    hasher.addValue(mesh.material);
  }
  for (const scenes::Instance& instance : scene.instances) hasher.addValue(instance.mesh).addValue(instance.toWorld);
  return hasher.hex();
}

std::string hashOfMaterials(const scenes::Scene& scene) {
  base::Hasher hasher;
  std::set<int> images;
  for (const scenes::Material& m : scene.materials) {
    hasher.addValue(m.baseColor).addValue(m.metallic).addValue(m.roughness).addValue(m.emissive);
    hasher.addValue(m.alphaCutoff).addValue(m.alphaMode).addValue(m.doubleSided).addValue(m.unlit);
    hasher.addValue(m.ior).addValue(m.specular).addValue(m.specularColor);
    hasher.addValue(m.normalScale).addValue(m.occlusionStrength);
    if (m.hasTransmission() && !m.castsShadow()) hasher.addValue(true); // other materials keep their keys
    for (const scenes::TextureSlot* slot :
         {&m.baseColorTexture, &m.metallicRoughnessTexture, &m.emissiveTexture, &m.normalTexture, &m.occlusionTexture,
          &m.specularTexture, &m.specularColorTexture}) {
      hasher.addValue(slot->image).addValue(slot->texCoord).addValue(slot->uvTransform);
      hasher.addValue(slot->sampler.wrapU).addValue(slot->sampler.wrapV).addValue(slot->sampler.magFilter);
      if (slot->present()) images.insert(slot->image);
    }
  }
  for (const int image : images) {
    const base::Image8& pixels = scene.images[static_cast<std::size_t>(image)].pixels;
    hasher.addValue(image).addValue(pixels.width).addValue(pixels.height);
    addAll(hasher, pixels.pixels);
  }
  return hasher.hex();
}

std::string hashOfSurfaces(const scenes::Scene& scene) {
  base::Hasher hasher;
  hasher.add(hashOfGeometry(scene)).add(hashOfMaterials(scene));
  for (const scenes::Mesh& mesh : scene.meshes) addAll(hasher, mesh.tangents);
  return hasher.hex();
}

} // namespace parity::lighting
