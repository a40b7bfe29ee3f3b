// Faces of a mesh into clusters that are flat enough to be projected onto a plane.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/mesh_faces.h"

namespace parity::bake {

// The most that a face's normal may lean away from its chart's: while charts grow, and when a tiny one is merged.
inline constexpr double kChartAngleDeg = 45, kMergeAngleDeg = 60;

struct Chart {
  glm::dvec3 normal{0};             // unit: of the plane that it is projected onto
  std::vector<std::uint32_t> faces; // joined over edges
};

// Every face with area is in one chart. Charts start at the largest flat regions, so that a floor or a wall is one
// chart; their borders then move by two rounds of "Variational Shape Approximation" (D. Cohen-Steiner, P. Alliez, M.
// Desbrun, 2004: metric L2,1, partition by distortion), each face within kChartAngleDeg of its chart's normal. Before
// each round charts go to the neighbour they have most edges with where kMergeAngleDeg allows it; after them, those of
// less than tinyArea.
std::vector<Chart> makeCharts(const MeshFaces& faces, double tinyArea);

// The parts of a set of faces that hang together over edges.
std::vector<std::vector<std::uint32_t>> connectedParts(const MeshFaces& faces,
                                                       const std::vector<std::uint32_t>& subset);

} // namespace parity::bake
