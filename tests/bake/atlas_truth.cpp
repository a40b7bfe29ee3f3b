// Brute force over sub-texels, in double precision and without the raster under test.
#include "bake/atlas_truth.h"

#include <algorithm>
#include <array>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace parity::tests {
namespace {

constexpr int kFactor = 4;
constexpr std::uint32_t kFree = 0xffffffffu;
using Corners = std::array<glm::dvec2, 3>;

double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Whether p is inside by more than `inset`.
bool holds(const Corners& t, const glm::dvec2& p, double inset) {
  const double sign = crossOf(t[1] - t[0], t[2] - t[0]) < 0 ? -1 : 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const glm::dvec2 edge = t[(k + 1) % 3] - t[k];
    if (sign * crossOf(edge, p - t[k]) <= inset * glm::length(edge)) return false;
  }
  return true;
}

// The chart of each triangle of an instance, numbered from `first` on.
std::vector<std::uint32_t> chartsOf(const scenes::Mesh& mesh, const glm::vec2* corners, std::uint32_t first,
                                    std::size_t& count) {
  std::vector<std::uint32_t> parent(mesh.indices.size() / 3);
  for (std::uint32_t t = 0; t < parent.size(); ++t) parent[t] = t;
  const auto rootOf = [&](std::uint32_t t) {
    while (parent[t] != t) t = parent[t] = parent[parent[t]];
    return t;
  };
  std::map<std::array<float, 5>, std::uint32_t> known;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const glm::vec3& p = mesh.positions[mesh.indices[i]];
    const auto triangle = static_cast<std::uint32_t>(i / 3);
    const auto [place, isNew] = known.try_emplace({p.x, p.y, p.z, corners[i].x, corners[i].y}, triangle);
    if (!isNew) parent[rootOf(triangle)] = rootOf(place->second);
  }
  std::map<std::uint32_t, std::uint32_t> numbers;
  std::vector<std::uint32_t> charts;
  for (std::uint32_t t = 0; t < parent.size(); ++t)
    charts.push_back(numbers.try_emplace(rootOf(t), first + numbers.size()).first->second);
  count = numbers.size();
  return charts;
}

int leastGapOf(const std::vector<std::uint32_t>& owner, int side) {
  constexpr int kReach = 5;
  int least = 1 << 20;
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const std::uint32_t here = owner[static_cast<std::size_t>(y) * side + x];
      if (here == kFree) continue;
      for (int v = y; v <= std::min(side - 1, y + kReach); ++v)
        for (int u = std::max(0, x - kReach); u <= std::min(side - 1, x + kReach); ++u) {
          const std::uint32_t there = owner[static_cast<std::size_t>(v) * side + u];
          if (there != kFree && there != here) least = std::min(least, std::max(std::abs(u - x), v - y) - 1);
        }
    }
  return least;
}

} // namespace

scenes::Scene sceneOf(scenes::Mesh mesh) {
  scenes::Scene scene;
  scene.name = "scene";
  scene.materials.emplace_back().name = "grey";
  if (mesh.name.empty()) mesh.name = "mesh";
  scene.meshes = {std::move(mesh)};
  scene.instances = {{0, glm::mat4(1.f), "node"}};
  return scene;
}

scenes::Mesh makeSoup(std::size_t triangles, float longest, unsigned seed) {
  std::mt19937 random(seed);
  const auto number = [&] { return static_cast<float>(random() % 65536) / 65536.f; };
  const auto vector = [&] {
    const float x = number(), y = number();
    return glm::vec3(x, y, number());
  };
  scenes::Mesh mesh;
  for (std::size_t t = 0; t < triangles; ++t) {
    const glm::vec3 place = vector();
    for (int k = 0; k < 3; ++k) {
      mesh.indices.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
      mesh.positions.push_back(place + longest * (vector() - 0.5f));
    }
  }
  mesh.normals.assign(mesh.positions.size(), glm::vec3(0, 1, 0));
  return mesh;
}

std::vector<glm::ivec2> cellsHeld(const Corners& t, double inset) {
  const glm::dvec2 lower = glm::floor(glm::min(glm::min(t[0], t[1]), t[2]) - 1.0);
  const glm::dvec2 upper = glm::max(glm::max(t[0], t[1]), t[2]) + 1.0;
  std::vector<glm::ivec2> cells;
  for (int y = std::max(0, static_cast<int>(lower.y)); y <= upper.y; ++y)
    for (int x = std::max(0, static_cast<int>(lower.x)); x <= upper.x; ++x)
      if (holds(t, {x + 0.5, y + 0.5}, inset)) cells.emplace_back(x, y);
  return cells;
}

AtlasFacts measureAtlas(const scenes::Scene& scene, const bake::Atlas& atlas) {
  AtlasFacts facts;
  const int side = atlas.pageSide;
  double uvArea = 0;
  for (int page = 0; page < atlas.pageCount; ++page) {
    std::vector<std::uint32_t> cells(static_cast<std::size_t>(side) * side * kFactor * kFactor, kFree);
    std::vector<std::uint32_t> owner(static_cast<std::size_t>(side) * side, kFree);
    std::uint32_t firstChart = 0, number = 0;
    for (std::size_t i = 0; i < scene.instances.size(); ++i) {
      const scenes::LightmapUvs::Place& place = atlas.uvs.places[i];
      if (place.page != page) continue;
      const scenes::Mesh& mesh = scene.meshes[scene.instances[i].mesh];
      const glm::mat4& toWorld = scene.instances[i].toWorld;
      const double scale = std::max({glm::length(toWorld[0]), glm::length(toWorld[1]), glm::length(toWorld[2])});
      const glm::vec2* uvs = atlas.uvs.corners.data() + place.firstCorner;
      std::size_t count = 0;
      const std::vector<std::uint32_t> charts = chartsOf(mesh, uvs, firstChart, count);
      std::vector<double> area(count, 0), texels(count, 0);
      for (std::size_t t = 0; t < charts.size(); ++t, ++number) {
        Corners corners;
        std::array<glm::dvec3, 3> p;
        for (std::size_t k = 0; k < 3; ++k) {
          corners[k] = glm::dvec2(uvs[3 * t + k] + place.offset) * static_cast<double>(side);
          p[k] = scale * glm::dvec3(mesh.positions[mesh.indices[3 * t + k]]);
          if (glm::any(glm::lessThan(corners[k], glm::dvec2(-1e-3))) ||
              glm::any(glm::greaterThan(corners[k], glm::dvec2(side + 1e-3))))
            ++facts.outside;
        }
        const double inSpace = 0.5 * glm::length(glm::cross(p[1] - p[0], p[2] - p[0]));
        const double inTexels = 0.5 * std::abs(crossOf(corners[1] - corners[0], corners[2] - corners[0]));
        const double longest = std::max({glm::length(p[1] - p[0]), glm::length(p[2] - p[1]), glm::length(p[0] - p[2])});
        if (inSpace <= 1e-6 * longest * longest) continue; // without area, or a needle whose figures are rounding
        if (!(inTexels > 0)) ++facts.collapsed;
        uvArea += inTexels;
        area[charts[t] - firstChart] += inSpace;
        texels[charts[t] - firstChart] += inTexels;
        if (inTexels > 0.05) // smaller ones are known to too few digits
          facts.leastTriangleDensity = std::min(facts.leastTriangleDensity, std::sqrt(inTexels / inSpace));
        for (glm::dvec2& corner : corners) corner *= kFactor;
        for (const glm::ivec2& cell : cellsHeld(corners, 0.05)) {
          std::uint32_t& taken = cells[static_cast<std::size_t>(cell.y) * side * kFactor + cell.x];
          facts.sharedSubTexels += taken != kFree;
          taken = number;
          owner[static_cast<std::size_t>(cell.y / kFactor) * side + cell.x / kFactor] = charts[t];
        }
      }
      for (std::size_t chart = 0; chart < count; ++chart)
        if (area[chart] > 0)
          facts.leastChartDensity = std::min(facts.leastChartDensity, std::sqrt(texels[chart] / area[chart]));
      firstChart += static_cast<std::uint32_t>(count);
    }
    facts.charts += firstChart;
    facts.leastGap = std::min(facts.leastGap, leastGapOf(owner, side));
  }
  facts.coverage = uvArea / (static_cast<double>(side) * side * atlas.pageCount);
  return facts;
}

void expectSound(const AtlasFacts& facts, const bake::AtlasOptions& options, const std::string& what) {
  EXPECT_EQ(facts.sharedSubTexels, 0u) << what;
  EXPECT_EQ(facts.outside, 0u) << what;
  EXPECT_EQ(facts.collapsed, 0u) << what;
  EXPECT_GE(facts.leastGap, options.padding) << what;
  EXPECT_GE(facts.leastChartDensity, 0.98 * options.texelsPerMetre) << what;
  // Charts merged at the last lean by kMergeAngleDeg at most: cos 60 deg of the area, its root of the density.
  EXPECT_GE(facts.leastTriangleDensity, 0.98 * std::sqrt(0.5) * options.texelsPerMetre) << what;
}

} // namespace parity::tests
