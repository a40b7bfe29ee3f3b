// builtin:lamps: more lights than the mobile path takes (docs/design.md 6e: up to 4), so that its cap shows.
#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

Light makePoint(const std::string& name, const glm::vec3& color, const glm::vec3& position, float range) {
  Light light;
  light.name = name;
  light.color = color;
  light.position = position;
  light.range = range;
  return light;
}

Light makeSpot(const std::string& name, const glm::vec3& color, const glm::vec3& position, const glm::vec3& target) {
  Light light = makePoint(name, color, position, 0);
  light.kind = LightKind::spot;
  light.direction = glm::normalize(target - position);
  light.innerConeAngle = glm::radians(14.f);
  light.outerConeAngle = glm::radians(24.f);
  return light;
}

} // namespace

// A floor and seven objects under six point lights in a ring, two spots from above and a dim directional light.
Scene makeLampsScene() {
  SceneBuilder builder("lamps");
  const Mesh sphere = makeSphere(0.5, 96, 48);
  builder.add(makeTeapot(), plastic("glazed teapot", {0.55f, 0.56f, 0.58f}, 0.15f), {0, 0, 0}, 25);
  const auto onRing = [](float radius, float degrees, float height) {
    const float a = glm::radians(degrees);
    return glm::vec3(radius * std::cos(a), height, radius * std::sin(a));
  };
  builder.add(sphere, metal("polished silver", {0.97f, 0.96f, 0.92f}, 0.12f), onRing(1.6f, 20, 0.5f));
  builder.add(sphere, metal("rough copper", {0.96f, 0.64f, 0.54f}, 0.5f), onRing(1.6f, 80, 0.5f));
  builder.add(makeRoundedBox(glm::dvec3(0.42), 0.09, 6), plastic("blue box", {0.07f, 0.16f, 0.50f}, 0.3f),
              onRing(1.65f, 140, 0.42f), 30);
  builder.add(sphere, plastic("white ball", glm::vec3(0.8f), 0.7f), onRing(1.6f, 200, 0.5f));
  builder.add(makeRoundedBox(glm::dvec3(0.38, 0.6, 0.38), 0.06, 6),
              plastic("green pillar", {0.08f, 0.35f, 0.12f}, 0.6f), onRing(1.75f, 262, 0.6f), 15);
  builder.add(makeTorusKnot(2, 3, 0.34, 0.1, 384, 24), metal("gold knot", {1.00f, 0.77f, 0.34f}, 0.3f),
              onRing(1.6f, 320, 0.3f));

  const glm::vec3 colors[] = {{1.0f, 0.35f, 0.15f}, {0.95f, 0.75f, 0.25f}, {0.25f, 0.9f, 0.35f},
                              {0.2f, 0.6f, 1.0f},   {0.45f, 0.3f, 1.0f},   {1.0f, 0.3f, 0.7f}};
  for (int i = 0; i < 6; ++i)
    builder.add(makePoint(fmt::format("lamp {}", i + 1), colors[i] * 1.6f,
                          onRing(2.1f, static_cast<float>(i) * 60 + 50, 0.9f), i % 2 ? 0.f : 4.f));
  builder.add(makeSpot("spot left", glm::vec3(1.0f, 0.95f, 0.85f) * 16.f, {-1.8f, 3.2f, 1.4f}, {-0.3f, 0.3f, 0.f}));
  builder.add(makeSpot("spot right", glm::vec3(0.8f, 0.9f, 1.0f) * 12.f, {2.0f, 3.0f, 1.6f}, {1.0f, 0.2f, 0.9f}));
  Light moon;
  moon.name = "moon";
  moon.kind = LightKind::directional;
  moon.color = glm::vec3(0.55f, 0.65f, 0.9f) * 0.35f;
  moon.direction = glm::normalize(glm::vec3(0.4f, -1.f, -0.5f));
  builder.add(moon);

  builder.setOrbitCamera(18, 56, 32); // fits the objects; the floor may leave the picture
  builder.add(makeFloor(3.2, 1, 32), plastic("floor", glm::vec3(0.45f), 0.55f), {0, 0, 0});
  return builder.finish(makeNight());
}

} // namespace parity::scenes
