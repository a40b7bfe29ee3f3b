// builtin:lobes: clear coats, sheens, anisotropy, thin films and light that passes through, one material a sphere.
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

constexpr int kLobeColumns = 6;
constexpr float kLobeMiddleRow = 5; // of eleven, of which one is empty
constexpr int kRowsAboveTheGap = 8;
constexpr float kLobeRadius = 0.46f;

constexpr glm::vec3 kGold{1.00f, 0.77f, 0.34f}, kSteel{0.56f, 0.57f, 0.58f}, kTitanium{0.54f, 0.50f, 0.45f};

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

Material brushed(std::string name, float roughness, float rotation) {
  Material material = metal(std::move(name), kSteel, roughness);
  material.anisotropy = 0.8f;
  material.anisotropyRotation = rotation;
  return material;
}

// A film with the index of an oxide, on titanium or on a black plastic; thickness in nm.
Material filmed(std::string name, bool isMetal, float roughness, float thickness) {
  Material material =
      isMetal ? metal(std::move(name), kTitanium, roughness) : plastic(std::move(name), glm::vec3(0.02f), roughness);
  material.iridescence = 1;
  material.iridescenceIor = 1.8f;
  material.iridescenceThicknessMax = thickness;
  return material;
}

// A pane, bent to a sphere: light passes its wall without refraction.
Material thinGlass(std::string name, float roughness) {
  Material material = plastic(std::move(name), {0.85f, 0.93f, 1.00f}, roughness);
  material.transmission = 1;
  return material;
}

// A ball of green glass.
Material glassBall(std::string name, float roughness) {
  Material material = plastic(std::move(name), glm::vec3(1.f), roughness);
  material.transmission = 1;
  material.thickness = 2 * kLobeRadius;
  material.attenuationDistance = 1;
  material.attenuationColor = {0.55f, 0.90f, 0.65f};
  return material;
}

// Paper, leaf, lamp shade.
Material translucent(std::string name, float share) {
  Material material = plastic(std::move(name), {0.55f, 0.60f, 0.45f}, 0.6f);
  material.diffuseTransmission = share;
  material.diffuseTransmissionColor = {0.85f, 0.80f, 0.45f};
  return material;
}

// Brushing in waves: its direction swings by 45 degrees to both sides of u, its strength goes from 0.4 to 1 along v.
TextureImage makeWavyBrushing(std::string name) {
  return makeTexture(std::move(name), 128, [](float u, float v) {
    constexpr float kTurn = 2 * std::numbers::pi_v<float>;
    const float angle = 0.125f * kTurn * std::sin(kTurn * u);
    return glm::vec4(0.5f + 0.5f * std::cos(angle), 0.5f + 0.5f * std::sin(angle), 0.7f + 0.3f * std::cos(kTurn * v),
                     1);
  });
}

// A film that has run, in the green channel.
TextureImage makeRunFilm(std::string name) {
  constexpr int kCells = 4;
  return makeTexture(std::move(name), 128, [](float u, float v) {
    return glm::vec4(1, periodicNoise(u * kCells, v * kCells, kCells, kCells, 3), 0, 1);
  });
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
// a red sheen and a white one of these; one sphere for each other thing that a coat or sheen can be or lie over;
// brushed steel of these roughnesses but 1, where no direction is seen, and with a texture; films of 200 nm and more
// over them, on plastic and on titanium in turn, and with a texture; diffuse transmission of three strengths,
// and light through both ways, a texture of transmission and a coat over it; and below a gap, since much
// light of their surroundings passes them, balls of glass of these roughnesses, with one that disperses, and thin glass
// of them.
Scene makeLobesScene() {
  SceneBuilder builder("lobes");
  const Mesh sphere = makeSphere(kLobeRadius, 96, 48);
  int placed = 0;
  const auto add = [&](const Material& material) {
    const int column = placed % kLobeColumns, full = placed / kLobeColumns, row = full + (full >= kRowsAboveTheGap);
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

  constexpr int kTextured = kLobeColumns - 1; // the last of a row
  constexpr float kEighth = 0.25f * std::numbers::pi_v<float>;
  for (int i = 0; i < kTextured; ++i) {
    const float roughness = static_cast<float>(i) / 5.f;
    add(i == 2   ? brushed("anisotropy 0.4 turned by 45", roughness, kEighth)
        : i == 4 ? brushed("anisotropy 0.8 turned by 90", roughness, 2 * kEighth)
                 : brushed(fmt::format("anisotropy {:.1f}", roughness), roughness, 0));
  }
  Material wavy = brushed("anisotropy texture", 0.3f, 0);
  wavy.anisotropyTexture = builder.texture(makeWavyBrushing("wavy brushing"), 2);
  add(wavy);
  for (int i = 0; i < kTextured; ++i) {
    const float roughness = static_cast<float>(i) / 5.f, thickness = 200 + 100 * static_cast<float>(i);
    add(filmed(fmt::format("film {:.1f}", roughness), i % 2 == 1, roughness, thickness));
  }
  Material oil = filmed("film texture", true, 0.2f, 700);
  oil.iridescenceThicknessMin = 200;
  oil.iridescenceThicknessTexture = builder.texture(makeRunFilm("run film"), 2);
  add(oil);

  for (const float share : {0.25f, 0.5f, 1.f}) add(translucent(fmt::format("translucent {:.2f}", share), share));
  Material opal = translucent("opal glass", 0.5f); // both ways
  opal.transmission = 0.5f;
  add(opal);
  Material window = thinGlass("glass texture", 0.1f);
  window.transmissionTexture = builder.texture(makeChecker("panes", 8, glm::vec3(1.f), glm::vec3(0.1f)), 2);
  add(window);
  Material coated = thinGlass("coat on glass", 0.5f);
  coated.coat = 1;
  add(coated);

  for (int i = 0; i < kTextured; ++i) {
    const float roughness = static_cast<float>(i) / 5.f;
    add(glassBall(fmt::format("glass {:.1f}", roughness), roughness));
  }
  Material prism = glassBall("dispersion", 0);
  prism.ior = 1.7f;
  prism.dispersion = 2; // three times as much as of flint glass
  add(prism);
  addSteps([](float r) { return thinGlass(fmt::format("thin glass {:.1f}", r), r); });

  builder.setOrbitCamera(0, 90, 25);
  return builder.finish(makeStudio());
}

} // namespace parity::scenes
