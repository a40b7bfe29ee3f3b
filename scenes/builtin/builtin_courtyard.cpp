// builtin:courtyard: shadows of every width, hard under a sun and soft under a sky, for baked shadows.
#include <cmath>

#include <glm/gtc/constants.hpp>

#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"
#include "scenes/view.h"

namespace parity::scenes {
namespace {

constexpr double kCourtyardSunAzimuthDeg = 62, kCourtyardSunElevationDeg = 40;

// A wall along X of this thickness, z from 0 to it, with a round-headed archway through its middle.
Mesh makeArchWall(double length, double height, double thickness, double archHalfWidth, double archSpring) {
  constexpr int kSteps = 16;
  Mesh mesh;
  const double end = 0.5 * length;
  // A part of the wall between two outlines, the same from both sides: (x, lower y) to the top.
  const auto addPart = [&](const glm::dvec2& left, const glm::dvec2& right) {
    const auto at = [](const glm::dvec2& p, double z) { return glm::dvec3(p, z); };
    const glm::dvec2 leftTop(left.x, height), rightTop(right.x, height);
    addQuad(mesh, at(leftTop, thickness), at(left, thickness), at(right, thickness), at(rightTop, thickness));
    addQuad(mesh, at(rightTop, 0), at(right, 0), at(left, 0), at(leftTop, 0));
    addQuad(mesh, at(leftTop, 0), at(leftTop, thickness), at(rightTop, thickness), at(rightTop, 0));
    addQuad(mesh, at(left, thickness), at(left, 0), at(right, 0), at(right, thickness));
  };
  const auto addSide = [&](double x, double y0, double y1, bool facesRight) {
    const double front = facesRight ? thickness : 0, back = thickness - front;
    addQuad(mesh, {x, y1, front}, {x, y0, front}, {x, y0, back}, {x, y1, back});
  };
  addPart({-end, 0}, {-archHalfWidth, 0});
  addPart({archHalfWidth, 0}, {end, 0});
  glm::dvec2 last(-archHalfWidth, archSpring);
  for (int i = 1; i <= kSteps; ++i) {
    const double angle = glm::pi<double>() * (kSteps - i) / kSteps;
    const glm::dvec2 next(i == kSteps ? archHalfWidth : archHalfWidth * std::cos(angle),
                          i == kSteps ? archSpring : archSpring + archHalfWidth * std::sin(angle));
    addPart(last, next);
    last = next;
  }
  addSide(-end, 0, height, false);
  addSide(end, 0, height, true);
  addSide(-archHalfWidth, 0, archSpring, true);
  addSide(archHalfWidth, 0, archSpring, false);
  return mesh;
}

// Four columns of 17 cm radius with foot and head, 1.7 m apart.
Mesh makeColonnade() {
  Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    const double x = -2.2 + 1.7 * i;
    appendMesh(mesh, makeBox({x - 0.24, 0, -0.24}, {x + 0.24, 0.15, 0.24}));
    appendMesh(mesh, makeRod({x, 0.15, 0}, {x, 2.1, 0}, 0.17, 32));
    appendMesh(mesh, makeBox({x - 0.22, 2.1, -0.22}, {x + 0.22, 2.25, 0.22}));
  }
  return mesh;
}

// Five posts of 3.5 cm radius, half a metre apart, and two rods of 3 cm along their fronts.
Mesh makeTrellis() {
  Mesh mesh;
  for (int i = 0; i < 5; ++i) {
    const double x = 0.5 * i;
    appendMesh(mesh, makeRod({x, 0, 0}, {x, 2.0, 0}, 0.035, 16));
  }
  for (const double y : {1.1, 1.94}) appendMesh(mesh, makeRod({-0.15, y, 0.066}, {2.15, y, 0.066}, 0.03, 16));
  return mesh;
}

// Two poles of 3.5 cm radius and 2.6 m height, to shade a wall.
Mesh makePoles() {
  Mesh mesh = makeRod({0, 0, 0}, {0, 2.6, 0}, 0.035, 16);
  appendMesh(mesh, makeRod({0, 0, 0.8}, {0, 2.6, 0.8}, 0.035, 16));
  return mesh;
}

// Three steps down along +X, each a box beside the next.
Mesh makeSteps() {
  Mesh mesh;
  for (int i = 0; i < 3; ++i) {
    const double x = 0.32 * i;
    appendMesh(mesh, makeBox({x, 0, -0.9}, {x + 0.32, 0.48 - 0.16 * i, 0.9}));
  }
  return mesh;
}

// A closed jar, turned about +Y, 0.62 m high.
Mesh makeJar() {
  return makeSurface(48, 32, [](double u, double v) {
    const double y = 1 - v, ends = std::sqrt(std::max(0.0, 1 - std::pow(2 * v - 1, 12.0)));
    const double radius = ends * (0.12 + 0.14 * std::sin(glm::pi<double>() * std::pow(y, 0.75)));
    const double angle = glm::two_pi<double>() * u;
    return glm::dvec3(radius * std::sin(angle), 0.62 * y, radius * std::cos(angle));
  });
}

// Slabs of half a metre with joints, shaded by noise; sRGB.
TextureImage makePaving() {
  return makeTexture("paving", 256, [](float u, float v) {
    const glm::vec2 at = glm::vec2(u, v) * 4.f, cell = glm::floor(at), inside = glm::abs(at - cell - 0.5f);
    const float tone = periodicNoise(cell.x * 1.7f, cell.y * 1.7f, 7, 7, 4) * 0.16f;
    const float grain = periodicNoise(u * 64, v * 64, 64, 64, 5) * 0.06f;
    const float joint = glm::smoothstep(0.47f, 0.49f, std::max(inside.x, inside.y));
    return glm::vec4(glm::vec3(0.66f, 0.63f, 0.57f) + tone + grain - 0.22f * joint, 1.f);
  });
}

} // namespace

// The sun from the right behind the eye: columns, trellis and arch throw their shadows on floor and walls.
Scene makeCourtyardScene() {
  SceneBuilder builder("courtyard");
  const Material stone = plastic("stone columns", {0.62f, 0.58f, 0.50f}, 0.7f);
  builder.add(makeColonnade(), stone, {-0.6f, 0.f, -2.35f});
  builder.add(makeBox({-3.15, 2.25, -2.6}, {2.85, 2.5, -2.1}), plastic("lintel", {0.58f, 0.54f, 0.47f}, 0.7f),
              {0, 0, 0});
  builder.add(makeBox({-3.15, 2.5, -3.7}, {2.95, 2.62, -1.95}), plastic("overhang", {0.48f, 0.20f, 0.11f}, 0.8f),
              {0, 0, 0});
  builder.add(makeBox({-3.7, 0, -4}, {4, 3, -3.7}), plastic("plaster wall", {0.74f, 0.68f, 0.58f}, 0.9f), {0, 0, 0});
  builder.add(makeArchWall(8, 2.9, 0.3, 0.75, 1.35), plastic("arch wall", {0.68f, 0.47f, 0.30f}, 0.9f),
              {-4.f, 0.f, 0.f}, 90);
  builder.add(makeSteps(), plastic("steps", {0.55f, 0.53f, 0.49f}, 0.75f), {-3.7f, 0.f, 0.f});
  builder.add(makeBox({3.1, 0, -2.2}, {3.4, 0.55, 2.2}), plastic("low wall", {0.72f, 0.67f, 0.58f}, 0.85f), {0, 0, 0});
  builder.add(makeTrellis(), plastic("trellis", {0.16f, 0.20f, 0.17f}, 0.5f), {0.2f, 0.f, 0.35f});
  builder.add(makePoles(), plastic("thin poles", {0.42f, 0.30f, 0.19f}, 0.6f), {-3.0f, 0.f, 2.5f});
  builder.add(makeJar(), plastic("terracotta jar", {0.56f, 0.24f, 0.13f}, 0.65f), {-1.5f, 0.f, 0.9f});
  builder.add(makeSphere(0.3, 64, 32), metal("metal ball", {1.00f, 0.77f, 0.40f}, 0.15f), {1.5f, 0.3f, 1.7f});

  Light sun = makeSun({kCourtyardSunAzimuthDeg, kCourtyardSunElevationDeg, 3.2f});
  sun.color *= glm::vec3(1.0f, 0.94f, 0.84f);
  builder.add(sun);
  builder.setOrbitCamera(24, 66, 11.6f, 48, {-0.35f, 0.6f, -0.2f});
  Material paving = plastic("paved floor", glm::vec3(1.f), 0.8f);
  paving.baseColorTexture = builder.texture(makePaving(), 4);
  builder.add(makeFloor(4, 1, 1), paving, {0, 0, 0});
  // Its sun is the scene's own light; the ground is as bright as if that shone on it.
  SkyOptions sky;
  sky.sunAzimuthDeg = kCourtyardSunAzimuthDeg;
  sky.sunElevationDeg = kCourtyardSunElevationDeg;
  sky.sunIrradiance = 0;
  sky.groundAlbedo = 0.5;
  return builder.finish(makeSky(sky));
}

} // namespace parity::scenes
