// Irradiance by sums of light vectors: tiles of normals against patches of the sky, patches in bundles.
#include "lighting/environment/irradiance_cube.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "lighting/environment/cube.h"
#include "lighting/environment/float4.h"
#include "lighting/environment/panorama.h"
#include "lighting/environment/prefilter.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;

// Directions within an angle of an axis.
struct Cone {
  glm::dvec3 axis{0.0, 1.0, 0.0}; // unit
  double angle = 0;               // radians, at most pi
  double cosine = 1, sine = 0;    // of the angle
};

Cone makeCone(const glm::dvec3& axis, double angle) {
  angle = std::min(angle, pi);
  return {axis, angle, std::cos(angle), std::sin(angle)};
}

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

Cone coneOf(std::span<const glm::dvec3> directions) {
  glm::dvec3 sum(0);
  for (const glm::dvec3& d : directions) sum += d;
  const glm::dvec3 axis = glm::normalize(sum);
  double angle = 0;
  for (const glm::dvec3& d : directions) angle = std::max(angle, angleBetween(d, axis));
  return makeCone(axis, angle);
}

Cone coneAround(std::span<const Cone> cones) {
  glm::dvec3 sum(0);
  for (const Cone& each : cones) sum += each.axis;
  const glm::dvec3 axis = glm::normalize(sum);
  double angle = 0;
  for (const Cone& each : cones) angle = std::max(angle, angleBetween(each.axis, axis) + each.angle);
  return makeCone(axis, angle);
}

// integral L(w) w dw of some part of the sky: row c is the vector of channel c.
using LightVectors = std::array<glm::dvec3, 3>;

void add(LightVectors& to, const LightVectors& from) {
  for (int c = 0; c < 3; ++c) to[c] += from[c];
}

struct Patch {
  Cone cone;
  LightVectors light{};
};

// Patches next to each other.
struct Bundle {
  Cone cone;
  LightVectors light{};
  std::vector<Patch> patches;
};

Bundle makeBundle(std::vector<Patch> patches) {
  Bundle bundle;
  std::vector<Cone> cones;
  for (const Patch& patch : patches) {
    cones.push_back(patch.cone);
    add(bundle.light, patch.light);
  }
  bundle.cone = coneAround(cones);
  bundle.patches = std::move(patches);
  return bundle;
}

// What the horizon may do to a part of the sky, seen from all normals of a tile.
enum class Horizon { below, cuts, above };
Horizon horizonOf(const Cone& tile, const Cone& sky) {
  // Above: the cosine between the axes is at least the sine of the reach, that is of both angles and a margin. Below:
  // it is at most the sine's negative. sin(reach + margin) = sine + margin cosine, to 1e-12.
  constexpr double kMargin = 1e-6; // radians
  if (tile.angle + sky.angle + kMargin >= pi / 2) return Horizon::cuts;
  const double sine = tile.sine * sky.cosine + tile.cosine * sky.sine,
               cosine = tile.cosine * sky.cosine - tile.sine * sky.sine;
  const double between = glm::dot(tile.axis, sky.axis);
  if (!(std::abs(between) >= sine + kMargin * cosine)) return Horizon::cuts;
  return between > 0 ? Horizon::above : Horizon::below;
}

constexpr int kTile = 4; // normals a side
constexpr int kGroups = kTile * kTile / 4;

// The normals of a tile of the irradiance cube, four to a group.
struct Tile {
  Cone cone;
  std::array<std::array<Float4, 3>, kGroups> normals{};
  std::array<std::array<Float4, 3>, kGroups> sums{}; // of the patches that the horizon cuts, by channel
  LightVectors whole{};                              // of those above it
};

Tile makeTile(int face, int x0, int y0) {
  Tile tile;
  std::array<glm::dvec3, kTile * kTile> directions;
  for (int i = 0; i < kTile * kTile; ++i) {
    directions[i] = texelDirection(face, x0 + i % kTile, y0 + i / kTile, kIrradianceFaceSize);
    for (int k = 0; k < 3; ++k) tile.normals[i / 4][k][i % 4] = static_cast<float>(directions[i][k]);
  }
  tile.cone = coneOf(directions);
  return tile;
}

void addCut(Tile& tile, const LightVectors& light) {
  for (int c = 0; c < 3; ++c) {
    const auto v = glm::vec3(light[c]);
    for (int g = 0; g < kGroups; ++g) {
      const auto& n = tile.normals[g];
      const Float4 e = n[0] * v.x + n[1] * v.y + n[2] * v.z;
      tile.sums[g][c] += e > 0 ? e : Float4{};
    }
  }
}

void addBundle(Tile& tile, const Bundle& bundle) {
  const Horizon all = horizonOf(tile.cone, bundle.cone);
  if (all == Horizon::below) return;
  if (all == Horizon::above) return add(tile.whole, bundle.light);
  for (const Patch& patch : bundle.patches) {
    const Horizon part = horizonOf(tile.cone, patch.cone);
    if (part == Horizon::above) add(tile.whole, patch.light);
    if (part == Horizon::cuts) addCut(tile, patch.light);
  }
}

std::vector<glm::vec4> sumOver(const std::vector<Bundle>& bundles) {
  constexpr int n = kIrradianceFaceSize, tiles = n / kTile;
  std::vector<glm::vec4> texels(texelIndex(kCubeFaces, 0, 0, n));
  base::parallelFor(kCubeFaces * tiles * tiles, 1, [&](std::size_t index, std::size_t) {
    const int face = static_cast<int>(index) / (tiles * tiles), x0 = static_cast<int>(index) % tiles * kTile,
              y0 = static_cast<int>(index) / tiles % tiles * kTile;
    Tile tile = makeTile(face, x0, y0);
    for (const Bundle& bundle : bundles) addBundle(tile, bundle);
    for (int i = 0; i < kTile * kTile; ++i) {
      const int x = x0 + i % kTile, y = y0 + i / kTile;
      const glm::dvec3 normal = texelDirection(face, x, y, n);
      glm::vec4 texel(1.f);
      for (int c = 0; c < 3; ++c)
        texel[c] = static_cast<float>((glm::dot(normal, tile.whole[c]) + tile.sums[i / 4][c][i % 4]) / pi);
      texels[texelIndex(face, x, y, n)] = texel;
    }
  });
  return fitBilinear(texels, n);
}

// integral w dw over a cell between two azimuths and two heights.
glm::dvec3 vectorOfCell(double azimuth, double width, double top, double bottom) {
  const auto belowArc = [](double y) { return (y * std::sqrt(std::max(0.0, 1 - y * y)) + std::asin(y)) / 2; };
  const double across = (belowArc(top) - belowArc(bottom)) * 2 * std::sin(width / 2);
  return {across * std::cos(azimuth), width * (top * top - bottom * bottom) / 2, across * std::sin(azimuth)};
}

glm::dvec3 directionAt(double azimuth, double y) {
  const double r = std::sqrt(std::max(0.0, 1 - y * y));
  return {r * std::cos(azimuth), y, r * std::sin(azimuth)};
}

// The cells [x0, x1) x [y0, y1).
Patch makePatch(const Panorama& p, int x0, int x1, int y0, int y1) {
  const double width = 2 * pi / p.width;
  Patch patch;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const glm::dvec3 v = vectorOfCell(p.azimuthAt(x + 0.5), width, p.rowY[y], p.rowY[y + 1]);
      for (int c = 0; c < 3; ++c) patch.light[c] += static_cast<double>(p.column(x)[y][c]) * v;
    }
  std::vector<glm::dvec3> rim;
  for (const double y : {p.rowY[y0], 0.5 * (p.rowY[y0] + p.rowY[y1]), p.rowY[y1]})
    for (const double x : {1.0 * x0, 0.5 * (x0 + x1), 1.0 * x1}) rim.push_back(directionAt(p.azimuthAt(x), y));
  patch.cone = coneOf(rim);
  return patch;
}

// How many of `parts` equal parts of `size` cells there are, each of at least one, and where part i begins.
struct Division {
  int size, parts;
  int begin(int i) const { return static_cast<int>(static_cast<std::int64_t>(size) * i / parts); }
};
Division divide(int size, int parts) { return {size, std::min(size, parts)}; }

constexpr int kPatchesAround = 256, kPatchesDown = 128, kBundleSide = 8;

} // namespace

std::vector<glm::vec4> makeIrradianceCube(const scenes::Environment& environment) {
  const Panorama p = makePanorama(environment, kPatchesAround);
  const Division across = divide(p.width, kPatchesAround), down = divide(p.height, kPatchesDown);
  const int bundlesAcross = (across.parts + kBundleSide - 1) / kBundleSide,
            bundlesDown = (down.parts + kBundleSide - 1) / kBundleSide;
  std::vector<Bundle> bundles(static_cast<std::size_t>(bundlesAcross) * bundlesDown);
  base::parallelFor(bundles.size(), 1, [&](std::size_t index, std::size_t) {
    const int left = static_cast<int>(index) % bundlesAcross * kBundleSide,
              top = static_cast<int>(index) / bundlesAcross * kBundleSide;
    std::vector<Patch> patches;
    for (int y = top; y < std::min(top + kBundleSide, down.parts); ++y)
      for (int x = left; x < std::min(left + kBundleSide, across.parts); ++x)
        patches.push_back(makePatch(p, across.begin(x), across.begin(x + 1), down.begin(y), down.begin(y + 1)));
    bundles[index] = makeBundle(std::move(patches));
  });
  return sumOver(bundles);
}

std::vector<glm::vec4> makeIrradianceCube(const std::vector<glm::vec4>& faces, int faceSize) {
  const int patches = std::min(faceSize, kPatchesAround / 4), cells = faceSize / patches,
            bundlesAcross = std::max(1, patches / kBundleSide), side = patches / bundlesAcross;
  const std::vector<double> angles = texelSolidAngles(faceSize);
  std::vector<Bundle> bundles(static_cast<std::size_t>(kCubeFaces) * bundlesAcross * bundlesAcross);
  const auto makeCubePatch = [&](int face, int x0, int y0) {
    Patch patch;
    for (int y = y0; y < y0 + cells; ++y)
      for (int x = x0; x < x0 + cells; ++x) {
        const glm::dvec3 v = angles[static_cast<std::size_t>(y) * faceSize + x] * texelDirection(face, x, y, faceSize);
        for (int c = 0; c < 3; ++c) patch.light[c] += double{faces[texelIndex(face, x, y, faceSize)][c]} * v;
      }
    std::vector<glm::dvec3> corners;
    for (const int y : {y0, y0 + cells})
      for (const int x : {x0, x0 + cells})
        corners.push_back(glm::normalize(directionOf({face, 2.0 * x / faceSize - 1, 2.0 * y / faceSize - 1})));
    patch.cone = coneOf(corners);
    return patch;
  };
  base::parallelFor(bundles.size(), 1, [&](std::size_t index, std::size_t) {
    const int perFace = bundlesAcross * bundlesAcross, face = static_cast<int>(index) / perFace,
              left = static_cast<int>(index) % bundlesAcross * side,
              top = static_cast<int>(index) % perFace / bundlesAcross * side;
    std::vector<Patch> parts;
    for (int y = top; y < top + side; ++y)
      for (int x = left; x < left + side; ++x) parts.push_back(makeCubePatch(face, x * cells, y * cells));
    bundles[index] = makeBundle(std::move(parts));
  });
  return sumOver(bundles);
}

} // namespace parity::lighting
