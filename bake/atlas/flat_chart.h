// A chart laid flat: faces of a mesh in a rectangle of texels.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

#include "bake/atlas/charts.h"
#include "scenes/scene.h"

namespace parity::bake {

using FlatFace = std::array<glm::dvec2, 3>; // corners in texels, y down

// The rectangle begins and ends at texel borders, and the faces touch its four sides: a rectangular chart covers its
// texels wholly. So a bilinear read within a chart reaches at most the next texel beyond its border, which dilation by
// one fills.
struct FlatChart {
  glm::ivec2 size{0};               // texels, >= 1
  std::vector<std::uint32_t> faces; // of the mesh
  std::vector<FlatFace> corners;    // of each
};

// Moves and widens faces so that their bounds are the smallest whole rectangle from (0, 0) that holds them, each axis
// by itself: by less than one texel.
void fitToTexels(FlatChart& chart);

// The smallest rectangle around the points has its long side along this unit vector (H. Freeman, R. Shapira, 1975: one
// of its sides lies on the convex hull; the 64 longest of those are tried).
glm::dvec2 tightestDirection(std::vector<glm::dvec2> points);

// The faces of a chart seen along its normal, `texelsPerUnit` of the mesh's units by mean over its area, turned to the
// smallest rectangle around them.
FlatChart projectChart(const scenes::Mesh& mesh, const MeshFaces& faces, const Chart& chart, double texelsPerUnit);

// The same in as many parts as it takes: where the projection lies over itself, what lies over goes to further charts;
// and a chart that leaves most of its rectangle free, such as a ring, is cut in halves or quarters where that saves
// texels. padding: texels that each rectangle costs beside it. Throws base::Error (exit 4) naming the mesh where a
// rectangle is longer than maxSide.
std::vector<FlatChart> flattenChart(const scenes::Mesh& mesh, const MeshFaces& faces, const Chart& chart,
                                    double texelsPerUnit, int padding, int maxSide);

} // namespace parity::bake
