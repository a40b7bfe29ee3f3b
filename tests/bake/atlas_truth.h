// An atlas seen by brute force: what its tests hold it to.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/atlas.h"
#include "scenes/scene.h"

namespace parity::tests {

// A scene of one mesh with one material, shown once.
scenes::Scene sceneOf(scenes::Mesh mesh);

// Triangles without neighbours, thrown into a unit cube; longest: of their edges, about.
scenes::Mesh makeSoup(std::size_t triangles, float longest, unsigned seed);

// The unit cells whose middles are inside a triangle by more than `inset` (negative: or as little outside).
std::vector<glm::ivec2> cellsHeld(const std::array<glm::dvec2, 3>& corners, double inset);

struct AtlasFacts {
  std::size_t sharedSubTexels = 0; // that two triangles hold by more than 1/20 of a sub-texel (4 to a texel's side)
  std::size_t outside = 0;         // corners that lie on no page
  std::size_t collapsed = 0;       // triangles with area in space and none in uv
  std::size_t charts = 0;          // triangles that share uvs at shared places are of one chart; of all instances
  int leastGap = 1 << 20;          // free texels between two charts, at least; as far as 4 are looked for
  double leastChartDensity =
      1e30; // by mean over a chart, texels a metre, the area in space measured by the largest scale
  double leastTriangleDensity = 1e30;
  double coverage = 0; // of the pages, by the charts' area
};

AtlasFacts measureAtlas(const scenes::Scene& scene, const bake::Atlas& atlas);

// Overlap, density, gap and so on as makeAtlas promises them for its own charts.
void expectSound(const AtlasFacts& facts, const bake::AtlasOptions& options, const std::string& what);

} // namespace parity::tests
