// KHR_materials_pbrSpecularGlossiness as what our materials can say.
#include "scenes/gltf/specular_glossiness.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "base/parallel.h"
#include "scenes/gltf/texture.h"
#include "shading/shading.h"

namespace parity::scenes {
namespace {

glm::dvec3 readColor(const tinygltf::Value& value, const char* key) {
  glm::dvec3 color(1);
  if (value.Has(key))
    for (int i = 0; i < 3; ++i) color[i] = std::clamp(value.Get(key).Get(i).GetNumberAsDouble(), 0.0, 1.0);
  return color;
}

bool haveSameUvs(const TextureSlot& a, const TextureSlot& b) {
  return a.texCoord == b.texCoord && a.uvTransform == b.uvTransform;
}

// The place in `derived`, as an image of a slot.
int addDerived(const GltfDocument& document, DerivedImages& derived, const DerivedImage& recipe) {
  const glm::vec3 &d = recipe.diffuseFactor, &s = recipe.specularFactor;
  const std::string key =
      fmt::format("{} {} {} {} {} {} {} {} {} {}", static_cast<int>(recipe.kind), recipe.specularGlossiness,
                  recipe.diffuse, d.x, d.y, d.z, s.x, s.y, s.z, recipe.glossinessFactor);
  const auto [found, isNew] = derived.places.try_emplace(key, derived.list.size());
  if (isNew) derived.list.push_back(recipe);
  return static_cast<int>(document.images.size() + found->second);
}

double toLinear(std::uint8_t code) {
  static const auto kTable = [] {
    std::array<double, 256> table;
    for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = shading::f64::srgbToLinear(i / 255.0);
    return table;
  }();
  return kTable[code];
}

std::uint8_t toByte(double value) { return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255)); }

// The larger of both, on each side.
glm::ivec2 sizeOf(const base::Image8* a, const base::Image8* b) {
  glm::ivec2 size(1);
  for (const base::Image8* source : {a, b})
    if (source) size = glm::max(size, glm::ivec2(source->width, source->height));
  return size;
}

// The nearest texel of an image at a place of a larger one.
const std::uint8_t* texelAt(const base::Image8& image, int x, int y, int width, int height) {
  const int px = static_cast<int>(static_cast<long long>(x) * image.width / width);
  const int py = static_cast<int>(static_cast<long long>(y) * image.height / height);
  return image.pixels.data() +
         (static_cast<std::size_t>(py) * static_cast<std::size_t>(image.width) + static_cast<std::size_t>(px)) * 4;
}

} // namespace

void readSpecularGlossiness(const GltfDocument& document, const tinygltf::Value& extension, const std::string& place,
                            Material& material, DerivedImages& derived, std::vector<std::string>& warnings) {
  const auto slotOf = [&](const char* key) {
    return extension.Has(key) ? readTextureSlot(document, extension.Get(key), fmt::format("{}/{}", place, key))
                              : TextureSlot{};
  };
  const glm::vec3 diffuse = readColor(extension, "diffuseFactor"), specular = readColor(extension, "specularFactor");
  const double alpha = extension.Has("diffuseFactor") ? extension.Get("diffuseFactor").Get(3).GetNumberAsDouble() : 1.0;
  const double glossiness =
      extension.Has("glossinessFactor") ? extension.Get("glossinessFactor").GetNumberAsDouble() : 1.0;
  const TextureSlot diffuseTexture = slotOf("diffuseTexture"), packed = slotOf("specularGlossinessTexture");

  material.metallic = 0;
  material.ior = 0;
  material.specular = 1;
  material.specularColor = specular;
  material.specularColorTexture = packed;
  material.specularTexture = {};
  DerivedImage recipe{.specularGlossiness = packed.image,
                      .specularFactor = specular,
                      .glossinessFactor = static_cast<float>(std::clamp(glossiness, 0.0, 1.0))};
  if (packed.present()) {
    material.roughness = 1;
    recipe.kind = DerivedImage::Kind::roughness;
    material.metallicRoughnessTexture = packed;
    material.metallicRoughnessTexture.image = addDerived(
        document, derived, {.specularGlossiness = packed.image, .glossinessFactor = recipe.glossinessFactor});
  } else {
    material.roughness = 1 - recipe.glossinessFactor;
    material.metallicRoughnessTexture = {};
  }

  const float kept = 1 - std::max({specular.x, specular.y, specular.z});
  const auto alphaFactor = static_cast<float>(std::clamp(alpha, 0.0, 1.0));
  material.baseColorTexture = diffuseTexture;
  if (!packed.present()) {
    material.baseColor = glm::vec4(diffuse * kept, alphaFactor);
  } else if (diffuseTexture.present() && !haveSameUvs(diffuseTexture, packed)) {
    material.baseColor = glm::vec4(diffuse, alphaFactor);
    warnings.push_back(
        fmt::format("{}: the specular colour does not reduce the diffuse colour, because their textures have "
                    "different uvs",
                    place));
  } else {
    material.baseColor = glm::vec4(1, 1, 1, alphaFactor);
    if (!diffuseTexture.present()) material.baseColorTexture = packed;
    recipe.kind = DerivedImage::Kind::baseColor;
    recipe.diffuse = diffuseTexture.image;
    recipe.diffuseFactor = diffuse;
    recipe.glossinessFactor = 1; // does not matter here: materials that differ in it share the image
    material.baseColorTexture.image = addDerived(document, derived, recipe);
  }
}

std::size_t texelsOf(const base::Image8* specularGlossiness, const base::Image8* diffuse) {
  const glm::ivec2 size = sizeOf(specularGlossiness, diffuse);
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

base::Image8 derive(const DerivedImage& recipe, const base::Image8* specularGlossiness, const base::Image8* diffuse) {
  const int width = sizeOf(specularGlossiness, diffuse).x, height = sizeOf(specularGlossiness, diffuse).y;
  static constexpr std::uint8_t kWhite[4] = {255, 255, 255, 255};
  base::Image8 out(width, height, 4);
  base::parallelFor(static_cast<std::size_t>(height), 16, [&](std::size_t begin, std::size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < width; ++x) {
        const std::uint8_t* s = specularGlossiness ? texelAt(*specularGlossiness, x, y, width, height) : kWhite;
        const std::uint8_t* d = diffuse ? texelAt(*diffuse, x, y, width, height) : kWhite;
        std::uint8_t* to =
            out.pixels.data() +
            (static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x)) * 4;
        if (recipe.kind == DerivedImage::Kind::roughness) {
          to[0] = to[2] = to[3] = 255;
          to[1] = toByte(1 - s[3] / 255.0 * recipe.glossinessFactor);
          continue;
        }
        double most = 0;
        for (int c = 0; c < 3; ++c) most = std::max(most, toLinear(s[c]) * recipe.specularFactor[c]);
        for (int c = 0; c < 3; ++c)
          to[c] = toByte(shading::f64::linearToSrgb(toLinear(d[c]) * recipe.diffuseFactor[c] * (1 - most)));
        to[3] = d[3];
      }
  });
  return out;
}

} // namespace parity::scenes
