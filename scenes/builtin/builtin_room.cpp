// builtin:room: a closed room that bounces tell most of, for lightmaps.
#include "scenes/builtin/builtin_scenes.h"
#include "scenes/builtin/generated_textures.h"
#include "scenes/builtin/procedural_environment.h"
#include "scenes/builtin/shapes.h"
#include "scenes/view.h"

namespace parity::scenes {
namespace {

// The air within, in metres, and the hole in the wall at +X.
constexpr glm::dvec3 kLower(-1.5, 0, -2), kUpper(1.5, 2.6, 2);
constexpr double kSill = 0.85, kLintel = 2.05, kWindowBack = -1.45, kWindowFront = -0.45, kWallThickness = 0.2;
constexpr double kRoomSunAzimuthDeg = -16, kRoomSunElevationDeg = 42;

// The walls' inner faces alone: what nobody can see takes no texels of a lightmap. They meet edge to edge.
Mesh makeQuad(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d) {
  Mesh mesh;
  addQuad(mesh, a, b, c, d);
  return mesh;
}

// The wall at +X with the window's hole and its four reveals.
Mesh makeWindowWall() {
  const double x = kUpper.x, outside = x + kWallThickness;
  Mesh mesh;
  const auto face = [&](double y0, double y1, double z0, double z1) { // towards -X
    addQuad(mesh, {x, y1, z0}, {x, y0, z0}, {x, y0, z1}, {x, y1, z1});
  };
  const double y[] = {kLower.y, kSill, kLintel, kUpper.y}, z[] = {kLower.z, kWindowBack, kWindowFront, kUpper.z};
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 3; ++column)
      if (row != 1 || column != 1) face(y[row], y[row + 1], z[column], z[column + 1]);
  const glm::dvec3 corners[] = {// around the hole, so that each reveal faces its middle
                                {x, kSill, kWindowBack},
                                {x, kLintel, kWindowBack},
                                {x, kLintel, kWindowFront},
                                {x, kSill, kWindowFront}};
  const glm::dvec3 out(outside - x, 0, 0);
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 &a = corners[i], &b = corners[(i + 1) % 4];
    addQuad(mesh, b, a, a + out, b + out);
  }
  return mesh;
}

// Angles outside of the twelve edges: a shadow map's bias lets no light in where two thin faces meet.
Mesh makeOuterEdges() {
  constexpr double kGap = 0.05, kLap = 0.2;
  Mesh mesh;
  for (int along = 0; along < 3; ++along)
    for (int edge = 0; edge < 4; ++edge)
      for (int side = 0; side < 2; ++side) {
        const int across = (along + 1 + side) % 3, other = 3 - along - across;
        const bool isUpper[2] = {(edge & 1) != 0, (edge & 2) != 0};
        const bool acrossUpper = isUpper[side], otherUpper = isUpper[1 - side];
        const double plane = acrossUpper ? kUpper[across] + kGap : kLower[across] - kGap;
        const double rim = otherUpper ? kUpper[other] + kGap : kLower[other] - kGap;
        const double inner = otherUpper ? rim - kLap : rim + kLap;
        const auto corner = [&](bool far, bool atRim) {
          glm::dvec3 p;
          p[along] = far ? kUpper[along] + kGap : kLower[along] - kGap;
          p[across] = plane;
          p[other] = atRim ? rim : inner;
          return p;
        };
        const glm::dvec3 a = corner(false, false), b = corner(true, false), c = corner(true, true),
                         d = corner(false, true);
        const bool facesOut = (glm::cross(b - a, d - a)[across] > 0) == acrossUpper;
        if (facesOut)
          addQuad(mesh, a, b, c, d);
        else
          addQuad(mesh, d, c, b, a);
      }
  return mesh;
}

void addWalls(SceneBuilder& builder) {
  const glm::dvec3 &l = kLower, &u = kUpper;
  const glm::vec3 white(0.72f, 0.69f, 0.63f);
  Material floor = plastic("floor", glm::vec3(1.f), 0.45f);
  // Eight squares a repeat, of 25 cm: uvs are in metres.
  floor.baseColorTexture = builder.texture(makeChecker("tiles", 8, {0.74f, 0.66f, 0.56f}, {0.58f, 0.46f, 0.36f}), 0.5f);
  builder.add(makeQuad({l.x, 0, l.z}, {l.x, 0, u.z}, {u.x, 0, u.z}, {u.x, 0, l.z}), floor, {0, 0, 0});
  builder.add(makeQuad({l.x, u.y, u.z}, {l.x, u.y, l.z}, {u.x, u.y, l.z}, {u.x, u.y, u.z}),
              plastic("ceiling", {0.75f, 0.74f, 0.71f}, 0.9f), {0, 0, 0});
  builder.add(makeQuad({l.x, u.y, l.z}, {l.x, 0, l.z}, {u.x, 0, l.z}, {u.x, u.y, l.z}),
              plastic("back wall", white, 0.9f), {0, 0, 0});
  builder.add(makeQuad({u.x, u.y, u.z}, {u.x, 0, u.z}, {l.x, 0, u.z}, {l.x, u.y, u.z}),
              plastic("front wall", white, 0.9f), {0, 0, 0});
  builder.add(makeQuad({l.x, u.y, u.z}, {l.x, 0, u.z}, {l.x, 0, l.z}, {l.x, u.y, l.z}),
              plastic("red wall", {0.57f, 0.09f, 0.06f}, 0.85f), {0, 0, 0});
  builder.add(makeWindowWall(), plastic("green wall", {0.14f, 0.43f, 0.11f}, 0.85f), {0, 0, 0});
  builder.add(makeOuterEdges(), plastic("outside wall", white, 0.9f), {0, 0, 0});
}

void addRoomLights(SceneBuilder& builder) {
  Light sun = makeSun({kRoomSunAzimuthDeg, kRoomSunElevationDeg, 9});
  sun.color *= glm::vec3(1.0f, 0.94f, 0.82f);
  builder.add(sun);
  Light lamp;
  lamp.name = "corner lamp";
  lamp.color = glm::vec3(1.0f, 0.66f, 0.34f) * 0.7f;
  lamp.position = {-1.0f, 1.75f, -1.5f};
  builder.add(lamp);
}

} // namespace

// A block, a metal and a glossy ball on a tiled floor; the sun falls through the window between them.
Scene makeRoomScene() {
  SceneBuilder builder("room");
  addWalls(builder);
  builder.add(makeSphere(0.36, 64, 32), metal("metal ball", {0.91f, 0.90f, 0.88f}, 0.12f), {-0.78f, 0.36f, -0.75f});
  builder.add(makeSphere(0.28, 64, 32), plastic("glossy ball", {0.06f, 0.16f, 0.46f}, 0.1f), {0.72f, 0.28f, -0.35f});
  builder.add(makeBox({-0.3, 0, -0.25}, {0.3, 0.9, 0.25}), plastic("block", {0.70f, 0.66f, 0.58f}, 0.7f),
              {0.2f, 0.f, -1.45f}, 18);
  // The panel hangs 5 mm below its housing, which ends in the ceiling.
  builder.add(makeBox({-0.5, 2.54, -0.35}, {0.5, 2.62, 0.35}), plastic("panel housing", glm::vec3(0.35f), 0.6f),
              {0, 0, 0});
  Material panel = plastic("panel", glm::vec3(0.1f), 0.8f);
  panel.emissive = {4.0f, 3.7f, 3.2f};
  builder.add(makeQuad({-0.45, 2.535, 0.3}, {-0.45, 2.535, -0.3}, {0.45, 2.535, -0.3}, {0.45, 2.535, 0.3}), panel,
              {0, 0, 0});
  addRoomLights(builder);
  builder.setOrbitCamera(0, 83, 2.6f, 74, {0.f, 1.05f, -0.75f});
  // Its sun is the scene's own light; the ground is as bright as if that shone on it.
  SkyOptions sky;
  sky.sunAzimuthDeg = kRoomSunAzimuthDeg;
  sky.sunElevationDeg = kRoomSunElevationDeg;
  sky.skyIrradiance = 3;
  sky.sunIrradiance = 0;
  sky.groundAlbedo = 0.5;
  return builder.finish(makeSky(sky));
}

} // namespace parity::scenes
