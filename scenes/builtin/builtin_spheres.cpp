// builtin:spheres: one material a sphere, so that the table of a report reads like a chart.
#include <fmt/format.h>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

constexpr int kSphereColumns = 6;

Mesh makeColoredSphere(const Mesh& sphere) {
  Mesh mesh = sphere;
  for (const glm::vec3& n : mesh.normals) mesh.colors.push_back(glm::vec4(n * 0.45f + 0.5f, 1.f));
  return mesh;
}

} // namespace

// Rows from the top: a metal and a dielectric of roughness 0 to 1 by fifths; coloured, textured and normal-mapped
// materials; one sphere for each flag and extension.
Scene makeSpheresScene() {
  SceneBuilder builder("spheres");
  const Mesh sphere = makeSphere(0.46, 96, 48);
  int placed = 0;
  const auto add = [&](const Mesh& mesh, const Material& material, float turnDeg = 0) {
    const int column = placed % kSphereColumns, row = placed / kSphereColumns;
    builder.add(mesh, material, glm::vec3(static_cast<float>(column) - 2.5f, 1.5f - static_cast<float>(row), 0.f),
                turnDeg);
    ++placed;
  };

  for (int i = 0; i < kSphereColumns; ++i)
    add(sphere,
        metal(fmt::format("metal {:.1f}", i / 5.0), glm::vec3(0.91f, 0.92f, 0.92f), static_cast<float>(i) / 5.f));
  for (int i = 0; i < kSphereColumns; ++i)
    add(sphere, plastic(fmt::format("dielectric {:.1f}", i / 5.0), glm::vec3(0.10f, 0.22f, 0.55f),
                        static_cast<float>(i) / 5.f));

  add(sphere, metal("gold", {1.00f, 0.77f, 0.34f}, 0.25f));
  add(sphere, metal("copper", {0.96f, 0.64f, 0.54f}, 0.45f));
  Material checker = plastic("checker", glm::vec3(1.f), 0.35f);
  checker.baseColorTexture =
      builder.texture(makeChecker("checker", 8, {0.90f, 0.88f, 0.82f}, {0.65f, 0.13f, 0.10f}), 2);
  add(sphere, checker);
  Material brushed = metal("brushed steel", {0.56f, 0.57f, 0.58f}, 0.55f);
  brushed.normalTexture = builder.texture(makeBrushedNormals("brushed normals"), 2);
  brushed.metallicRoughnessTexture = builder.texture(makeBrushedRoughness("brushed roughness"), 2);
  add(sphere, brushed);
  Material fabric = plastic("fabric", glm::vec3(1.f), 0.9f);
  fabric.baseColorTexture =
      builder.texture(makeWovenColor("woven colour", 16, {0.30f, 0.42f, 0.62f}, {0.56f, 0.62f, 0.72f}), 3);
  fabric.normalTexture = builder.texture(makeWovenNormals("woven normals", 16), 3);
  add(sphere, fabric);
  Material holes = plastic("alpha mask", {0.12f, 0.42f, 0.20f}, 0.4f);
  holes.baseColorTexture = builder.texture(makeHoles("holes", 4), 3);
  holes.alphaMode = AlphaMode::mask;
  holes.doubleSided = true;
  add(sphere, holes);

  Material clay = plastic("fully rough clay", {0.55f, 0.28f, 0.18f}, 1.f);
  clay.fullyRough = true;
  add(sphere, clay);
  Material glow = plastic("emissive", glm::vec3(0.05f), 0.5f);
  glow.emissive = {1.6f, 0.7f, 0.2f};
  add(sphere, glow);
  Material flat = plastic("unlit", {0.20f, 0.55f, 0.60f}, 1.f);
  flat.unlit = true;
  add(sphere, flat);
  Material tinted = plastic("tinted specular", glm::vec3(0.04f), 0.3f);
  tinted.specularColor = {0.35f, 1.00f, 0.55f};
  add(sphere, tinted);
  Material gem = plastic("high ior", {0.45f, 0.02f, 0.06f}, 0.1f);
  gem.ior = 2.4f;
  add(sphere, gem);
  add(makeColoredSphere(sphere), plastic("vertex colours", glm::vec3(1.f), 0.5f));

  builder.setOrbitCamera(0, 90, 25);
  return builder.finish(makeStudio());
}

} // namespace parity::scenes
