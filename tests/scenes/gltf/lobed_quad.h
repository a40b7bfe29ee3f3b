// A quad for tests of the lobes that extensions give a material: two uv sets, five textures.
#pragma once

#include "scenes/gltf/gltf_writer.h"

namespace parity::tests {

// Image i of five is 4 + i texels wide, and texture i shows it. u of TEXCOORD_0 runs along x, that of TEXCOORD_1 along
// y.
inline GltfFile makeLobed() {
  GltfFile file = makeQuad();
  file.json["samplers"] = {{{"wrapS", 33071}, {"wrapT", 33648}}};
  for (int i = 0; i < 5; ++i) {
    file.json["images"].push_back({{"bufferView", file.addBufferView(makePng(4 + i, 2))}, {"mimeType", "image/png"}});
    file.json["textures"].push_back({{"source", i}, {"sampler", 0}});
  }
  file.primitive()["attributes"]["TEXCOORD_1"] = file.add<float>({0, 0, 0, 1, 1, 1, 1, 0}, "VEC2");
  return file;
}

inline nlohmann::json textured(int texture, int texCoord = 0) { return {{"index", texture}, {"texCoord", texCoord}}; }

// A material's extensions with this one alone.
inline nlohmann::json anisotropyOf(const nlohmann::json& members) { return {{"KHR_materials_anisotropy", members}}; }

inline scenes::Scene loadWithExtensions(const nlohmann::json& extensions) {
  GltfFile file = makeLobed();
  file.material()["extensions"] = extensions;
  return loadQuadlike(file);
}

// Of the image that a slot shows; 0 without one.
inline int widthOf(const scenes::Scene& scene, const scenes::TextureSlot& slot) {
  return slot.present() ? scene.images.at(static_cast<std::size_t>(slot.image)).pixels.width : 0;
}

} // namespace parity::tests
