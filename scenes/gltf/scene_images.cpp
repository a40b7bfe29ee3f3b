// The images of a scene: of those in the file the ones that its materials read, and those computed from them.
#include "scenes/gltf/scene_images.h"

#include <algorithm>

#include <fmt/format.h>

#include "scenes/gltf/image.h"
#include "scenes/names.h"
#include "scenes/texture_slots.h"

namespace parity::scenes {
namespace {

template <typename Body> void forEachSlot(Material& material, const Body& body) {
  for (const NamedSlot& each : kTextureSlots)
    if (TextureSlot& slot = material.*each.slot; slot.present()) body(slot);
}

// Sorted, each once.
std::vector<int> sortUnique(std::vector<int> values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
  return values;
}

// The images that these materials read, by the numbers of their slots.
std::vector<int> imagesOf(std::vector<Material>& materials, const std::vector<bool>* isShown) {
  std::vector<int> images;
  for (std::size_t m = 0; m < materials.size(); ++m)
    if (!isShown || (*isShown)[m])
      forEachSlot(materials[m], [&](const TextureSlot& slot) { images.push_back(slot.image); });
  return sortUnique(std::move(images));
}

std::size_t placeIn(const std::vector<int>& sorted, int value) {
  return static_cast<std::size_t>(std::lower_bound(sorted.begin(), sorted.end(), value) - sorted.begin());
}

bool contains(const std::vector<int>& sorted, int value) {
  return std::binary_search(sorted.begin(), sorted.end(), value);
}

} // namespace

std::vector<SourceFile> readSceneImages(const GltfDocument& document, const std::vector<DerivedImage>& derived,
                                        const std::vector<bool>& isShown, Scene& scene, Problems& problems) {
  const int ownCount = static_cast<int>(document.images.size());
  const auto recipeOf = [&](int image) -> const DerivedImage& {
    return derived[static_cast<std::size_t>(image - ownCount)];
  };
  const std::vector<int> used = imagesOf(scene.materials, nullptr), read = imagesOf(scene.materials, &isShown);
  for (Material& material : scene.materials)
    forEachSlot(material, [&](TextureSlot& slot) { slot.image = static_cast<int>(placeIn(used, slot.image)); });

  std::vector<int> sources; // what is decoded: images of the file
  for (const int image : read) {
    if (image < ownCount) {
      sources.push_back(image);
      continue;
    }
    for (const int source : {recipeOf(image).specularGlossiness, recipeOf(image).diffuse})
      if (source >= 0) sources.push_back(source);
  }
  sources = sortUnique(std::move(sources));
  DecodedImages decoded = decodeImages(document, sources, problems);
  scene.warnings.insert(scene.warnings.end(), decoded.warnings.begin(), decoded.warnings.end());
  const auto pixelsOf = [&](int image) -> const base::Image8* {
    if (image < 0) return nullptr;
    const base::Image8& pixels = decoded.images[placeIn(sources, image)].pixels;
    return pixels.empty() ? nullptr : &pixels; // a problem of its own
  };

  const auto fileOf = [&](int image) {
    return cleanName(document.images[static_cast<std::size_t>(image)].named.filename().string());
  };
  std::size_t derivedTexels = 0;
  for (const int image : used) {
    TextureImage& out = scene.images.emplace_back();
    if (image < ownCount) {
      out.name = document.images[static_cast<std::size_t>(image)].name;
      out.file = fileOf(image);
      continue;
    }
    const DerivedImage& recipe = recipeOf(image);
    const bool isRoughness = recipe.kind == DerivedImage::Kind::roughness;
    const int source = isRoughness || recipe.diffuse < 0 ? recipe.specularGlossiness : recipe.diffuse;
    out.name = fmt::format("{} ({})", document.images[static_cast<std::size_t>(source)].name,
                           isRoughness ? "roughness of glossiness" : "diffuse less specular");
    out.file = fileOf(source);
    if (!contains(read, image)) continue;
    const base::Image8 *packed = pixelsOf(recipe.specularGlossiness), *diffuse = pixelsOf(recipe.diffuse);
    problems.attempt([&] {
      const std::string place = fmt::format("/images/{}", source);
      const std::size_t count = texelsOf(packed, diffuse);
      derivedTexels += count;
      if (derivedTexels > document.options.maxImageTexels)
        throw document.error(place,
                             fmt::format("the images computed from it and others have more than {} texels together "
                                         "(--max-image)",
                                         document.options.maxImageTexels));
      document.memory.take(4 * count, place);
      out.pixels = derive(recipe, packed, diffuse);
    });
  }
  for (const int image : read) // after the derived ones have read them
    if (image < ownCount)
      scene.images[placeIn(used, image)].pixels = std::move(decoded.images[placeIn(sources, image)].pixels);
  return std::move(decoded.sources);
}

} // namespace parity::scenes
