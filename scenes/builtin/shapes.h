// Generated meshes for the built-in scenes. Metres, +Y up, counter-clockwise seen from outside, uv v down.
#pragma once

#include <functional>
#include <vector>

#include <glm/glm.hpp>

#include "scenes/scene.h"

namespace parity::scenes {

// The surface p(u, v) over [0,1]^2 as a grid of columns x rows quads, u to the right and v down where it is seen from
// outside. Normals by central differences of p (a pole takes that of a point just beside it), uv = (u, v). Triangles
// without area are left out.
Mesh makeSurface(int columns, int rows, const std::function<glm::dvec3(double u, double v)>& p);

// Normals are exact. segments around, rings from pole to pole.
Mesh makeSphere(double radius, int segments, int rings);

// A closed (p,q) torus knot about +Y, p times around the axis, of a round tube.
Mesh makeTorusKnot(int p, int q, double radius, double tubeRadius, int segments, int sides);

// A box with round edges; each face has uv over [0,1]^2. steps: subdivisions of each rounded edge.
Mesh makeRoundedBox(const glm::dvec3& halfExtent, double edgeRadius, int steps);

// A straight rod from one point to another, closed by flat ends.
Mesh makeRod(const glm::dvec3& from, const glm::dvec3& to, double radius, int sides);

// A closed ring of a round tube about `axis` (unit) through the origin.
Mesh makeRing(const glm::dvec3& axis, double radius, double tubeRadius, int segments, int sides);

// An upright rectangle on y = 0 that faces +Z, uv over [0, 1]^2.
Mesh makeCard(double width, double height);

// A teapot: turned body and lid, a spout and a handle. Stands on y = 0, about 1 high and 2 wide (spout towards +X).
Mesh makeTeapot();

// A rectangle in y = 0 facing +Y, uv over [0, repeats]^2, cells quads a side.
Mesh makeFloor(double halfSize, float repeats, int cells);

// Adds a flat quad with corners counter-clockwise seen from its front, its uv (0, 0) at a, in metres along a-d and a-b.
void addQuad(Mesh& mesh, const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& d);

// A closed box with sharp edges, uv in metres.
Mesh makeBox(const glm::dvec3& lower, const glm::dvec3& upper);

// Adds `part` to `mesh`, moved by a rigid transform with uniform scale.
void appendMesh(Mesh& mesh, const Mesh& part, const glm::mat4& transform = glm::mat4(1.f));

} // namespace parity::scenes
