// builtin:lights: a thousand lights, of which about eight reach a point: what light culling is for.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <glm/gtc/constants.hpp>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"

namespace parity::scenes {
namespace {

constexpr int kTileColumns = 14, kTileRows = 18; // of spheres, and of tiles of the floor, a metre from each other
constexpr int kLightCount = 1000;
constexpr float kRange = 0.95f;     // about eight reach a point of a sphere (tests/scenes/builtin_lights_test.cpp)
constexpr float kClearance = 0.18f; // from spheres and floor, so that nothing is burnt out
constexpr float kTop = 1.0f;        // of the lights

// The i-th point of Halton's sequence (1960): i's digits to a base, mirrored at the point. In [0, 1).
double halton(int i, int base) {
  double value = 0, digit = 1;
  for (; i > 0; i /= base) value += (digit /= base) * (i % base);
  return value;
}

struct Ball {
  glm::vec3 center;
  float radius;
};

// On the floor, of radii from 0.28 to 0.43.
std::vector<Ball> makeField() {
  std::vector<Ball> field;
  for (int z = 0; z < kTileRows; ++z)
    for (int x = 0; x < kTileColumns; ++x) {
      const float radius = 0.28f + 0.15f * static_cast<float>(halton(z * kTileColumns + x + 1, 11));
      const glm::vec3 center(static_cast<float>(2 * x - kTileColumns + 1), 2 * radius,
                             static_cast<float>(2 * z - kTileRows + 1));
      field.push_back({0.5f * center, radius});
    }
  return field;
}

// Full hues from red over green and blue back to red, all of about one brightness.
glm::vec3 colorOf(double hue) {
  const auto wave = [&](double phase) { return 0.5 + 0.5 * std::cos(glm::two_pi<double>() * (hue - phase)); };
  const glm::dvec3 color = glm::mix(glm::dvec3(wave(0), wave(1.0 / 3), wave(2.0 / 3)), glm::dvec3(0.5), 0.1);
  const double luminance = glm::dot(color, glm::dvec3(0.2126, 0.7152, 0.0722));
  return glm::vec3(color * (0.5 / std::sqrt(luminance)));
}

// Spread over the field by Halton's sequence; points too near to a sphere are left out.
std::vector<Light> makeLamps(const std::vector<Ball>& field) {
  std::vector<Light> lamps;
  for (int i = 1; lamps.size() < kLightCount; ++i) {
    const glm::dvec3 at(halton(i, 2), halton(i, 5), halton(i, 3));
    Light lamp;
    lamp.position = glm::mix(glm::vec3(-0.5f * kTileColumns, kClearance, -0.5f * kTileRows),
                             glm::vec3(0.5f * kTileColumns, kTop, 0.5f * kTileRows), glm::vec3(at));
    const auto isTooNear = [&](const Ball& ball) {
      return glm::distance(lamp.position, ball.center) < ball.radius + kClearance;
    };
    if (std::any_of(field.begin(), field.end(), isTooNear)) continue;
    const auto number = static_cast<int>(lamps.size()) + 1;
    lamp.name = fmt::format("lamp {}", number);
    lamp.color = colorOf(number * (glm::golden_ratio<double>() - 1)) * 0.55f;
    lamp.range = kRange;
    lamps.push_back(lamp);
  }
  return lamps;
}

} // namespace

// 252 spheres of seven materials on a floor, at night, among 1,000 coloured lamps. The floor is of tiles, as the mobile
// path takes its lights object by object.
Scene makeLightsScene() {
  SceneBuilder builder("lights");
  const Material materials[] = {
      metal("gold", {1.00f, 0.77f, 0.34f}, 0.3f),
      plastic("white plastic", glm::vec3(0.8f), 0.35f),
      metal("rough copper", {0.96f, 0.64f, 0.54f}, 0.55f),
      plastic("black lacquer", glm::vec3(0.03f), 0.15f),
      metal("satin steel", {0.56f, 0.57f, 0.58f}, 0.42f),
      plastic("blue rubber", {0.20f, 0.32f, 0.65f}, 0.85f),
      metal("polished silver", {0.97f, 0.96f, 0.92f}, 0.15f),
  };
  constexpr int kMaterials = static_cast<int>(std::size(materials));
  for (const Material& material : materials) builder.addMesh(makeSphere(1, 32, 16), material);

  const std::vector<Ball> field = makeField();
  for (int i = 0; i < kTileColumns * kTileRows; ++i) {
    const int which = (3 * (i % kTileColumns) + 2 * (i / kTileColumns)) % kMaterials; // no two neighbours alike
    const Ball& ball = field[static_cast<std::size_t>(i)];
    builder.place(static_cast<std::uint32_t>(which), fmt::format("{} {}", materials[which].name, i), ball.center, 0,
                  ball.radius);
  }
  for (const Light& lamp : makeLamps(field)) builder.add(lamp);
  builder.setOrbitCamera(0, 38, 39.4f, 24, {0, 0.4f, 0.9f}); // the floor goes on beyond the picture

  const std::uint32_t tile = builder.addMesh(makeFloor(0.5, 1, 1), plastic("floor", glm::vec3(0.4f), 0.5f));
  for (const Ball& ball : field) builder.place(tile, "floor", {ball.center.x, 0, ball.center.z});
  for (int z = -1; z <= 1; ++z) // large ones around the field
    for (int x = -1; x <= 1; ++x)
      if (x || z)
        builder.place(tile, "floor", {x * (z ? kTileRows : (kTileRows + kTileColumns) / 2), 0, z * kTileRows}, 0,
                      kTileRows);
  return builder.finish(makeNight());
}

} // namespace parity::scenes
