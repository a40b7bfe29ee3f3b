// builtin:room lets light in by its window alone; builtin:courtyard has the shadows that its objects promise.
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "lighting/surface/visibility.h"
#include "scenes/builtin/builtin.h"

namespace parity::lighting {
namespace {

using scenes::LightKind;
using scenes::Scene;

// The window's hole, where the wall at +X has its inner face.
constexpr double kWall = 1.5, kSill = 0.85, kLintel = 2.05, kWindowBack = -1.45, kWindowFront = -0.45;

const scenes::Light& sunOf(const Scene& scene) {
  return *std::find_if(scene.lights.begin(), scene.lights.end(),
                       [](const auto& light) { return light.kind == LightKind::directional; });
}

Scene without(Scene scene, const std::string& node) {
  if (std::erase_if(scene.instances, [&](const auto& instance) { return instance.node == node; }) == 0)
    throw std::runtime_error("no object '" + node + "'");
  return scene;
}

double areaOf(const Scene& scene, const std::string& node) {
  double area = 0;
  for (const scenes::Instance& instance : scene.instances) {
    if (!node.empty() && instance.node != node) continue;
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) { // nothing is scaled
      const glm::vec3 a = mesh.positions[mesh.indices[i]];
      area += 0.5 *
              glm::length(glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a));
    }
  }
  return area;
}

// Rays of random directions from random points of the air inside, balls and block not left out: how many get out other
// than by the window, and the share that gets out by it.
struct Escapes {
  int elsewhere = 0;
  double byWindow = 0;
};
Escapes findEscapes(const Scene& scene, int count) {
  const Visibility visibility(scene);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0, 1);
  std::normal_distribution<double> normal;
  Escapes escapes;
  int byWindow = 0;
  for (int i = 0; i < count; ++i) {
    const glm::dvec3 origin(2.98 * (unit(random) - 0.5), 0.01 + 2.5 * unit(random), 3.98 * (unit(random) - 0.5));
    glm::dvec3 direction = glm::normalize(glm::dvec3(normal(random), normal(random), normal(random)));
    if (i % 4 == 0) { // towards an edge of the room, where faces meet
      const int axis = i / 4 % 3;
      glm::dvec3 edge(i & 16 ? 1.5 : -1.5, i & 32 ? 2.6 : 0, i & 64 ? 2 : -2);
      edge[axis] = origin[axis];
      direction = glm::normalize(edge - origin);
    }
    if (visibility.isOccluded(origin, direction)) continue;
    const glm::dvec3 met = origin + direction * ((kWall - origin.x) / direction.x);
    const bool isWindow =
        direction.x > 0 && met.y > kSill && met.y < kLintel && met.z > kWindowBack && met.z < kWindowFront;
    ++(isWindow ? byWindow : escapes.elsewhere);
  }
  escapes.byWindow = static_cast<double>(byWindow) / count;
  return escapes;
}

TEST(BuiltinRoom, IsLeftByItsWindowAlone) {
  const Scene room = scenes::makeBuiltinScene("room");
  for (const Scene& scene : {room, without(room, "outside wall")}) { // the inner faces close by themselves
    const Escapes escapes = findEscapes(scene, 400'000);
    EXPECT_EQ(escapes.elsewhere, 0);
    EXPECT_GT(escapes.byWindow, 0.005);
    EXPECT_LT(escapes.byWindow, 0.05);
  }
  EXPECT_GT(findEscapes(without(room, "ceiling"), 10'000).elsewhere, 1000); // the test sees holes
}

TEST(BuiltinRoom, FacesItsInside) {
  const Scene room = scenes::makeBuiltinScene("room");
  for (const scenes::Instance& instance : room.instances) {
    const bool isShell = instance.node.ends_with("wall") || instance.node == "floor" || instance.node == "ceiling";
    if (!isShell) continue;
    const bool isOutside = instance.node == "outside wall";
    const scenes::Mesh& mesh = room.meshes[instance.mesh];
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
      const glm::vec3 a = mesh.positions[mesh.indices[i]];
      const glm::vec3 normal =
          glm::cross(mesh.positions[mesh.indices[i + 1]] - a, mesh.positions[mesh.indices[i + 2]] - a);
      const glm::vec3 inside(1.4f, 1.45f, -0.95f); // before the middle of the window: its reveals, too, face it
      EXPECT_EQ(glm::dot(normal, inside - a) > 0, !isOutside) << instance.node << " " << i / 3;
    }
  }
  EXPECT_LT(areaOf(room, "outside wall"), 0.2 * areaOf(room, "")); // most texels are seen
}

TEST(BuiltinRoom, HasSunOnSomeOfItsFloorAndABakedLampAndAGlowingPanel) {
  const Scene room = scenes::makeBuiltinScene("room");
  const Visibility visibility(room);
  const glm::dvec3 towardsSun = -glm::dvec3(sunOf(room).direction);
  int lit = 0, count = 0;
  for (double x = -1.49; x < 1.5; x += 0.02)
    for (double z = -1.99; z < 2; z += 0.02, ++count) lit += !visibility.isOccluded({x, 1e-4, z}, towardsSun);
  EXPECT_GT(lit, 0.03 * count);
  EXPECT_LT(lit, 0.15 * count);
  EXPECT_EQ(std::count_if(room.lights.begin(), room.lights.end(),
                          [](const auto& light) { return light.kind == LightKind::point; }),
            1);
  EXPECT_EQ(std::count_if(room.materials.begin(), room.materials.end(),
                          [](const auto& m) {
                            return std::min({m.emissive.x, m.emissive.y, m.emissive.z}) > 1;
                          }),
            1);
}

TEST(BuiltinBaked, ScenesAreSmallAndOfPlausibleAlbedo) {
  for (const char* name : {"room", "courtyard"}) {
    const Scene scene = scenes::makeBuiltinScene(name);
    EXPECT_LT(scene.triangleCount(), 30'000u) << name;
    for (const scenes::Material& material : scene.materials) {
      if (material.metallic > 0) continue;
      const bool isTextured = material.baseColorTexture.present(); // the texture holds the colour
      for (int c = 0; c < 3; ++c) EXPECT_LE(isTextured ? 0 : material.baseColor[c], 0.75f) << material.name;
    }
    for (const scenes::TextureImage& image : scene.images) // sRGB 224 is .75
      for (std::size_t i = 0; i < image.pixels.pixels.size(); ++i)
        if (i % 4 != 3) {
          ASSERT_LE(image.pixels.pixels[i], 224) << image.name;
        }
  }
}

// The share of points of an area, origin + (s, t) in [0, 1]^2 along two sides, that an object alone takes the sun from.
double shadowShare(const Scene& scene, const std::string& node, const glm::dvec3& origin, const glm::dvec3& s,
                   const glm::dvec3& t) {
  const Visibility with(scene), free(without(scene, node));
  const glm::dvec3 towardsSun = -glm::dvec3(sunOf(scene).direction);
  constexpr int kSteps = 300;
  int shaded = 0;
  for (int i = 0; i < kSteps; ++i)
    for (int k = 0; k < kSteps; ++k) {
      const glm::dvec3 p = origin + s * ((i + 0.5) / kSteps) + t * ((k + 0.5) / kSteps);
      shaded += with.isOccluded(p, towardsSun) && !free.isOccluded(p, towardsSun);
    }
  return static_cast<double>(shaded) / (kSteps * kSteps);
}

TEST(BuiltinCourtyard, HasThinShadowsOnFloorAndWallAndAnOverhangsShade) {
  const Scene yard = scenes::makeBuiltinScene("courtyard");
  const glm::dvec3 floor(-3.6, 1e-4, -3.6), x(7, 0, 0), z(0, 0, 7.5), archWall(-3.7 + 1e-4, 0, -4), y(0, 2.9, 0);
  const double trellis = shadowShare(yard, "trellis", floor, x, z);
  EXPECT_GT(trellis, 0.01);
  EXPECT_LT(trellis, 0.05);
  EXPECT_GT(shadowShare(yard, "thin poles", archWall, z, y), 0.003);
  EXPECT_GT(shadowShare(yard, "stone columns", floor, x, z), 0.02);
  const glm::dvec3 wall(-3, 1.5, -3.7 + 1e-4);
  EXPECT_GT(shadowShare(yard, "overhang", wall, {5, 0, 0}, {0, 1, 0}), 0.3);
}

} // namespace
} // namespace parity::lighting
