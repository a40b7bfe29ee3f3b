// builtin:lobes: clear coats and sheens, one material a sphere.
#include <fmt/format.h>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

constexpr int kLobeColumns = 6;
constexpr float kLobeMiddleRow = 2; // of five

constexpr glm::vec3 kGold{1.00f, 0.77f, 0.34f};

Material carPaint(std::string name, float coatRoughness) {
  Material material = plastic(std::move(name), {0.20f, 0.012f, 0.015f}, 0.6f);
  material.metallic = 0.5f; // flakes
  material.coat = 1;
  material.coatRoughness = coatRoughness;
  return material;
}

Material cloth(std::string name, const glm::vec3& color, const glm::vec3& sheenColor, float sheenRoughness) {
  Material material = plastic(std::move(name), color, 0.8f);
  material.sheenColor = sheenColor;
  material.sheenRoughness = sheenRoughness;
  return material;
}

// Dents as a sprayed lacquer has them.
TextureImage makeOrangePeel(std::string name) {
  constexpr int kCells = 16;
  return makeNormalMap(std::move(name), 256, [](float u, float v) {
    return 0.012f * periodicNoise(u * kCells, v * kCells, kCells, kCells, 7);
  });
}

} // namespace

// Rows from the top: a coat of roughness 0 to 1 by fifths over car paint; a smooth coat over gold of these roughnesses;
// a red sheen and a white one of these; one sphere for each other thing that a coat or sheen can be or lie over.
Scene makeLobesScene() {
  SceneBuilder builder("lobes");
  const Mesh sphere = makeSphere(0.46, 96, 48);
  int placed = 0;
  const auto add = [&](const Material& material) {
    const int column = placed % kLobeColumns, row = placed / kLobeColumns;
    builder.add(sphere, material,
                glm::vec3(static_cast<float>(column) - 2.5f, kLobeMiddleRow - static_cast<float>(row), 0.f));
    ++placed;
  };
  const auto addSteps = [&](const auto& make) {
    for (int i = 0; i < kLobeColumns; ++i) add(make(static_cast<float>(i) / 5.f));
  };

  addSteps([](float r) { return carPaint(fmt::format("coat {:.1f}", r), r); });
  addSteps([](float r) {
    Material material = metal(fmt::format("coat on gold {:.1f}", r), kGold, r);
    material.coat = 1;
    material.coatRoughness = 0.05f;
    return material;
  });
  addSteps([](float r) {
    return cloth(fmt::format("sheen {:.1f}", r), {0.12f, 0.015f, 0.015f}, {0.90f, 0.20f, 0.15f}, r);
  });
  addSteps([](float r) { return cloth(fmt::format("sheen white {:.1f}", r), glm::vec3(0.02f), glm::vec3(0.80f), r); });

  Material half = carPaint("half coat", 0.1f);
  half.coat = 0.5f;
  add(half);
  Material peel = carPaint("coat normal map", 0.05f);
  peel.coatNormalTexture = builder.texture(makeOrangePeel("orange peel"), 2);
  add(peel);
  Material carbon = metal("coat on normal map", glm::vec3(0.25f), 0.45f);
  carbon.normalTexture = builder.texture(makeWovenNormals("woven normals", 16), 3);
  carbon.coat = 1;
  carbon.coatRoughness = 0.05f;
  add(carbon);
  Material velvet = cloth("sheen texture", {0.03f, 0.04f, 0.10f}, glm::vec3(1.f), 0.5f);
  velvet.sheenColorTexture =
      builder.texture(makeChecker("velvet checker", 8, {0.75f, 0.80f, 0.95f}, {0.35f, 0.25f, 0.75f}), 2);
  add(velvet);
  Material lacquered = cloth("coat on sheen", {0.05f, 0.10f, 0.06f}, {0.40f, 0.80f, 0.50f}, 0.4f);
  lacquered.coat = 1;
  lacquered.coatRoughness = 0.1f;
  add(lacquered);
  Material lamp = plastic("coat on emissive", glm::vec3(0.05f), 0.5f);
  lamp.emissive = {0.4f, 0.16f, 0.05f}; // the coat still shows
  lamp.coat = 1;
  lamp.coatRoughness = 0.1f;
  add(lamp);

  builder.setOrbitCamera(0, 90, 25);
  return builder.finish(makeStudio());
}

} // namespace parity::scenes
