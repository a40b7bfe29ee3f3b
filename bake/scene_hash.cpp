#include "bake/scene_hash.h"

#include <set>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/hash.h"

namespace parity::bake {

namespace {

template <typename T> void addAll(base::Hasher& hasher, const std::vector<T>& list) {
  hasher.addValue(list.size()).add(std::as_bytes(std::span{list}));
}

std::string hashGeometry(const scenes::Scene& scene) {
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

std::string hashMaterials(const scenes::Scene& scene) {
  base::Hasher hasher;
  std::set<int> images;
  for (const scenes::Material& m : scene.materials) {
    hasher.addValue(m.baseColor).addValue(m.metallic).addValue(m.roughness).addValue(m.emissive);
    hasher.addValue(m.alphaCutoff).addValue(m.alphaMode).addValue(m.doubleSided).addValue(m.unlit);
    hasher.addValue(m.ior).addValue(m.specular).addValue(m.specularColor);
    hasher.addValue(m.normalScale).addValue(m.occlusionStrength);
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

std::string hashLights(const BakeLights& lights) {
  base::Hasher hasher;
  hasher.addValue(lights.lights.size()).addValue(lights.sun.value_or(lights.lights.size()));
  for (const scenes::Light& light : lights.lights)
    hasher.addValue(light.kind)
        .addValue(light.color)
        .addValue(light.position)
        .addValue(light.direction)
        .addValue(light.range)
        .addValue(light.falloff)
        .addValue(light.falloffExponent)
        .addValue(light.innerConeAngle)
        .addValue(light.outerConeAngle);
  return hasher.hex();
}

std::string hashSky(const BakeLights& lights) {
  base::Hasher hasher;
  hasher.addValue(lights.environment.has_value());
  if (lights.environment) {
    hasher.addValue(lights.environment->rotationDeg).addValue(lights.environment->radiance.width);
    addAll(hasher, lights.environment->radiance.pixels);
  }
  return hasher.hex();
}

} // namespace

SceneHashes hashScene(const scenes::Scene& scene, const BakeLights& lights) {
  return {hashGeometry(scene), hashMaterials(scene), hashLights(lights), hashSky(lights)};
}

std::string describeChange(const SceneHashes& baked, const SceneHashes& now) {
  std::vector<std::string> parts;
  if (baked.geometry != now.geometry) parts.emplace_back("geometry");
  if (baked.materials != now.materials) parts.emplace_back("materials");
  if (baked.lights != now.lights) parts.emplace_back("lights");
  if (baked.sky != now.sky) parts.emplace_back("environment");
  if (parts.empty()) return {};
  return fmt::format("stale: not the {} that it was baked from", fmt::join(parts, ", "));
}

} // namespace parity::bake
