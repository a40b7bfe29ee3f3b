// builtin:materials: a still life of materials that people know from their own tables.
#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {

// Eight objects of eight materials on a matte floor. Reflectances of metals at normal incidence are measured ones
// (physicallybased.info); albedos stay between charcoal (0.04) and fresh plaster (0.8).
Scene makeMaterialsScene() {
  SceneBuilder builder("materials");
  const Mesh ball = makeSphere(0.5, 128, 64);
  const Mesh cube = makeRoundedBox(glm::dvec3(0.42), 0.10, 8);

  Material ceramic = plastic("glazed ceramic", {0.72f, 0.70f, 0.64f}, 0.12f);
  builder.add(makeTeapot(), ceramic, {-0.70f, 0.f, -1.15f}, 20, 1.15f);
  builder.add(makeTorusKnot(2, 3, 0.62, 0.17, 512, 32), metal("gold", {1.00f, 0.773f, 0.307f}, 0.22f),
              {1.15f, 0.55f, -1.0f}, 10);

  Material steel = metal("brushed steel", {0.56f, 0.57f, 0.58f}, 0.45f);
  steel.normalTexture = builder.texture(makeBrushedNormals("brushed normals"), 2);
  steel.metallicRoughnessTexture = builder.texture(makeBrushedRoughness("brushed roughness"), 2);
  builder.add(ball, steel, {-1.60f, 0.5f, 0.15f});

  builder.add(cube, plastic("red plastic", {0.55f, 0.03f, 0.025f}, 0.28f), {-0.50f, 0.42f, 0.25f}, 32);

  Material rubber = plastic("rubber", {0.045f, 0.046f, 0.048f}, 0.88f);
  builder.add(ball, rubber, {0.55f, 0.42f, 0.55f}, 0, 0.84f);

  Material fabric = plastic("fabric", glm::vec3(1.f), 0.92f);
  fabric.baseColorTexture =
      builder.texture(makeWovenColor("woven colour", 16, {0.42f, 0.50f, 0.36f}, {0.70f, 0.68f, 0.55f}), 2);
  fabric.normalTexture = builder.texture(makeWovenNormals("woven normals", 16), 2);
  builder.add(cube, fabric, {1.62f, 0.42f, 0.45f}, -24);

  builder.add(ball, plastic("glossy blue paint", {0.015f, 0.06f, 0.30f}, 0.05f), {-0.62f, 0.35f, 1.45f}, 0, 0.7f);

  Material clay = plastic("terracotta", {0.44f, 0.17f, 0.09f}, 1.f);
  clay.fullyRough = true;
  builder.add(ball, clay, {0.50f, 0.32f, 1.50f}, 0, 0.64f);

  builder.setOrbitCamera(12, 60, 28); // fits the objects; the floor may leave the picture
  builder.add(makeFloor(3.2, 1, 32), plastic("matte floor", {0.32f, 0.31f, 0.30f}, 0.95f), {0, 0, 0});
  return builder.finish(makeStudio());
}

} // namespace parity::scenes
