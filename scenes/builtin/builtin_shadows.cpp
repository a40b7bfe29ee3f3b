// builtin:shadows: what shadow maps get wrong, one object a fault.
#include <cmath>

#include <glm/gtc/constants.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

constexpr glm::vec3 kLantern(-0.48f, 0.46f, -0.35f); // the middle of the cage, where the lamp is

// Seven rods of 2 cm radius in a row along +X.
Mesh makeColumns() {
  Mesh mesh;
  for (int i = 0; i < 7; ++i) {
    const double x = 0.15 * i;
    appendMesh(mesh, makeRod({x, 0, 0}, {x, 0.85, 0}, 0.02, 24));
  }
  return mesh;
}

// A plank 1 m long that leans with one end on 12 cm and has 1 cm of air below the other.
Mesh makePlank() {
  Mesh mesh;
  const float lean = std::atan2(0.11f, 1.f);
  const glm::mat4 toWorld =
      glm::rotate(glm::translate(glm::mat4(1.f), glm::vec3(0, 0.065f + 0.006f, 0)), -lean, glm::vec3(0, 0, 1));
  appendMesh(mesh, makeRoundedBox({0.5, 0.006, 0.14}, 0.002, 2), toWorld);
  return mesh;
}

// Rings about the origin as the meridians and parallels of a globe, open to every side, on a post.
Mesh makeCage() {
  constexpr double kRadius = 0.17, kBar = 0.008;
  Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    const double angle = glm::quarter_pi<double>() * (i + 0.5);
    appendMesh(mesh, makeRing({std::cos(angle), 0, std::sin(angle)}, kRadius, kBar, 64, 12));
  }
  for (const double height : {-0.5, 0.0, 0.5}) {
    const double radius = kRadius * std::sqrt(1 - height * height);
    appendMesh(mesh, makeRing({0, 1, 0}, radius, kBar, 64, 12),
               glm::translate(glm::mat4(1.f), glm::vec3(0, height * kRadius, 0)));
  }
  appendMesh(mesh, makeRod({0, -kLantern.y, 0}, {0, -kRadius, 0}, 0.014, 24));
  return mesh;
}

void addShadowLights(SceneBuilder& builder) {
  Light sun;
  sun.name = "sun";
  sun.kind = LightKind::directional;
  sun.color = glm::vec3(1.0f, 0.95f, 0.85f) * 1.8f;
  sun.direction = glm::normalize(glm::vec3(0.62f, -0.72f, 0.30f));
  builder.add(sun);
  Light lamp;
  lamp.name = "lantern";
  lamp.color = glm::vec3(1.0f, 0.62f, 0.28f) * 0.7f;
  lamp.position = kLantern;
  lamp.range = 5;
  builder.add(lamp);
  Light spot;
  spot.name = "spot";
  spot.kind = LightKind::spot;
  spot.color = glm::vec3(0.55f, 0.75f, 1.0f) * 8.f;
  spot.position = {1.9f, 2.1f, 1.3f};
  spot.direction = glm::normalize(glm::vec3(0.45f, 0.1f, -0.2f) - spot.position);
  spot.innerConeAngle = glm::radians(16.f);
  spot.outerConeAngle = glm::radians(24.f);
  spot.range = 8;
  builder.add(spot);
}

} // namespace

// Under a low sun from behind, a lamp within a cage and a spot from the right, in the dim light of a night.
Scene makeShadowsScene() {
  SceneBuilder builder("shadows");
  // Meets the floor without a gap, and right behind it stands what no sun may reach.
  builder.add(makeRoundedBox({0.015, 0.37, 0.65}, 0.004, 2), plastic("thin wall", {0.60f, 0.56f, 0.50f}, 0.8f),
              {-1.25f, 0.35f, -0.45f});
  builder.add(makeRoundedBox({0.1, 0.1, 0.16}, 0.01, 3), plastic("box behind the wall", {0.65f, 0.20f, 0.12f}, 0.6f),
              {-1.133f, 0.1f, -0.35f});
  builder.add(makeCage(), metal("lantern", {0.55f, 0.50f, 0.44f}, 0.4f), kLantern);
  builder.add(makeColumns(), plastic("thin columns", {0.70f, 0.68f, 0.62f}, 0.5f), {0.2f, 0.f, -0.95f});
  builder.add(makeTorusKnot(2, 3, 0.26, 0.075, 768, 48), metal("torus knot", {1.00f, 0.77f, 0.34f}, 0.35f),
              {0.32f, 0.18f, -0.25f}, 20);
  builder.add(makeSphere(0.22, 96, 48), plastic("resting ball", {0.75f, 0.73f, 0.70f}, 0.35f), {-0.72f, 0.22f, 0.40f});
  builder.add(makeRoundedBox({0.17, 0.11, 0.17}, 0.015, 4), plastic("floating box", {0.14f, 0.30f, 0.60f}, 0.4f),
              {-0.22f, 0.12f, 0.78f}, 25);
  builder.add(makeRoundedBox({0.05, 0.06, 0.16}, 0.004, 2), plastic("plinth", {0.35f, 0.34f, 0.33f}, 0.7f),
              {0.27f, 0.06f, 0.85f});
  builder.add(makePlank(), plastic("leaning plank", {0.50f, 0.33f, 0.18f}, 0.6f), {0.72f, 0.f, 0.85f});

  Material leaves = plastic("leaves", glm::vec3(1.f), 0.7f);
  leaves.baseColorTexture = builder.texture(makeLeaves("leaves", 5));
  leaves.alphaMode = AlphaMode::mask;
  leaves.doubleSided = true;
  builder.add(makeCard(0.8, 0.7), leaves, {1.0f, 0.f, 0.f}, 40);
  Material pane = plastic("blended pane", {0.10f, 0.60f, 0.55f}, 0.1f);
  pane.baseColor.a = 0.45f;
  pane.alphaMode = AlphaMode::blend;
  pane.doubleSided = true;
  builder.add(makeCard(0.5, 0.55), pane, {-0.94f, 0.f, 0.74f}, -38);

  addShadowLights(builder);
  builder.setOrbitCamera(6, 57, 5.2f, 30, {0.02f, 0.22f, 0.02f}); // fits the objects; the floor may leave the picture
  builder.add(makeFloor(2.2, 1, 22), plastic("floor", glm::vec3(0.5f), 0.75f), {0, 0, 0});
  return builder.finish(makeNight());
}

} // namespace parity::scenes
