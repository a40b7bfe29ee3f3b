// KHR_materials_pbrSpecularGlossiness as what our materials can say.
#pragma once

#include <map>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/gltf/file/document.h"
#include "scenes/scene.h"

namespace parity::scenes {

// An image that is computed from others. Indices into document.images; -1: none, read as white.
struct DerivedImage {
  enum class Kind { roughness, baseColor };
  Kind kind = Kind::roughness;
  int specularGlossiness = -1, diffuse = -1;
  glm::vec3 diffuseFactor{1.f}, specularFactor{1.f};
  float glossinessFactor = 1;
};

struct DerivedImages {
  std::vector<DerivedImage> list;
  std::map<std::string, std::size_t> places; // in the list, by all that a recipe says: each is made once
};

// Sets base colour, metallic, roughness, F0 and their textures from the extension: a dielectric whose F0 is `specular`
// (ior 0 stands for F0 = 1, KHR_materials_ior, which specularColor scales), whose base colour is diffuse * (1 -
// max(specular)) and whose roughness is 1 - glossiness, as the extension's own text has it. Images that no file holds
// are appended to `derived`; a slot's image of document.images.size() + i is derived.list[i]. Where the two textures
// have other uvs the base colour cannot be combined: it stays `diffuse`, with a line in `warnings`. Throws Error (exit
// 4).
void readSpecularGlossiness(const GltfDocument& document, const tinygltf::Value& extension, const std::string& place,
                            Material& material, DerivedImages& derived, std::vector<std::string>& warnings);

// Texels of the image that derive() makes.
std::size_t texelsOf(const base::Image8* specularGlossiness, const base::Image8* diffuse);

// The image, from decoded ones (8 bit RGBA; colours sRGB); either may be null. Of the larger of their sizes, the other
// one read at the nearest texel. roughness: G; baseColor: RGB sRGB, A of diffuse. Bytes are rounded to nearest.
base::Image8 derive(const DerivedImage& recipe, const base::Image8* specularGlossiness, const base::Image8* diffuse);

} // namespace parity::scenes
