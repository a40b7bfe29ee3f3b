// Tangent frames per triangle corner by MikkTSpace (M. Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited"),
// the convention that normal maps are baked in and that glTF 2.0 (3.7.2.1) asks for.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace parity::scenes {

// A triangle list; positions, unit normals and uv of equal length, finite; 3 indices a triangle, all in range.
struct TangentInput {
  std::span<const glm::vec3> positions, normals;
  std::span<const glm::vec2> uv;
  std::span<const std::uint32_t> indices;
};

// The tangent of each corner: xyz unit and at right angles to the normal; w = -1 where the triangle's uv has positive
// area, else +1 (glTF's v runs down, so this is the negative of the reference code's sign). All four are 0 where
// nothing defines a tangent. In short:
// - vertices of the same position, normal and uv are one;
// - the corners at a vertex form groups: corners of triangles that share an edge there, run through in opposite
//   directions, and have the same orientation in uv;
// - a group's tangent is the sum of its triangles' directions dP/du (eq. 18), each laid into the vertex's plane, made
//   unit length and weighted by the corner's angle in that plane;
// - a triangle without a direction (no area in uv, ...) joins its neighbours' groups and adds nothing to them; one with
//   two corners at the same position takes the tangent of another triangle at the same vertex.
// As the public code at its default threshold of 180 degrees, but that nothing depends on the order of triangles or
// vertices, also where that code takes what comes first: over an edge of three and more triangles all of equal
// orientation join; a triangle without a direction takes the orientation that most of its neighbours have (nearest ones
// first); one that must choose between groups takes the one with the largest sum of angles. Where a sum vanishes
// (directions exactly opposed, which the threshold splits there), each corner has its own triangle's direction.
// Linear in the number of triangles but for the sorting of each vertex's edges; runs in parallel.
std::vector<glm::vec4> makeCornerTangents(const TangentInput& mesh);

} // namespace parity::scenes
