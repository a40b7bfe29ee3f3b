// What is in a scene, in numbers and words.
#include "scenes/scene_info.h"

#include <fmt/format.h>

#include "scenes/texture_slots.h"

namespace parity::scenes {
namespace {

template <typename T> std::size_t bytesOf(const std::vector<T>& values) { return values.size() * sizeof(T); }

std::size_t bytesOf(const Mesh& mesh) {
  return bytesOf(mesh.positions) + bytesOf(mesh.normals) + bytesOf(mesh.tangents) + bytesOf(mesh.uv0) +
         bytesOf(mesh.uv1) + bytesOf(mesh.colors) + bytesOf(mesh.indices);
}

MaterialInfo describe(const Scene& scene, const Material& material, std::size_t triangles, bool hasColors) {
  MaterialInfo info;
  info.name = material.name;
  info.f0 = material.dielectricF0();
  info.triangles = triangles;
  for (const NamedSlot& each : kTextureSlots)
    if (const TextureSlot& slot = material.*each.slot; slot.present()) {
      const TextureImage& image = scene.images[static_cast<std::size_t>(slot.image)];
      info.textures.push_back(image.pixels.pixels.empty() ? fmt::format("{}: {}", each.name, image.name)
                                                          : fmt::format("{}: {} ({}x{})", each.name, image.name,
                                                                        image.pixels.width, image.pixels.height));
    }
  const auto add = [&](bool applies, const char* flag) {
    if (applies) info.flags.emplace_back(flag);
  };
  add(material.unlit, "unlit");
  add(!material.unlit && material.isNonmetal(), "nonmetal");
  add(material.fullyRough, "fully rough");
  add(!info.textures.empty(), "textured");
  add(material.normalTexture.present(), "normal map");
  add(hasColors, "vertex colours");
  add(material.emissive != glm::vec3(0), "emissive");
  add(material.hasCoat(), "coat");
  add(material.hasSheen(), "sheen");
  add(material.hasAnisotropy(), "anisotropy");
  add(material.hasIridescence(), "iridescence");
  add(material.hasTransmission(), "transmission");
  add(material.hasDiffuseTransmission(), "diffuse transmission");
  add(material.hasVolume(), "volume");
  add(material.alphaMode == AlphaMode::mask, "alpha mask");
  add(material.alphaMode == AlphaMode::blend, "alpha blend");
  add(material.doubleSided, "double-sided");
  add(triangles == 0, "not shown");
  return info;
}

} // namespace

SceneInfo describeScene(const Scene& scene) {
  SceneInfo info;
  std::vector<std::size_t> triangles(scene.materials.size());
  std::vector<bool> hasColors(scene.materials.size());
  info.instances = scene.instances.size();
  for (const Instance& instance : scene.instances) {
    const Mesh& mesh = scene.meshes[instance.mesh];
    triangles[mesh.material] += mesh.indices.size() / 3;
    info.triangles += mesh.indices.size() / 3;
  }
  for (const Mesh& mesh : scene.meshes) {
    if (!mesh.colors.empty()) hasColors[mesh.material] = true;
    info.vertices += mesh.positions.size();
    info.meshBytes += bytesOf(mesh);
  }
  for (std::size_t m = 0; m < scene.materials.size(); ++m)
    info.materials.push_back(describe(scene, scene.materials[m], triangles[m], hasColors[m]));
  for (const TextureImage& image : scene.images) {
    info.images += !image.pixels.pixels.empty();
    info.texels += image.pixels.pixelCount();
    info.imageBytes += bytesOf(image.pixels.pixels);
  }
  info.bounds = scene.bounds();
  return info;
}

} // namespace parity::scenes
