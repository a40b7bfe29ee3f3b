// What a mesh lacks or has wrong, mended on the CPU: triangle lists, flat normals, broken normals.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scenes/scene.h"

namespace parity::scenes {

// Turns the indices of a strip or a fan into a list (glTF 2.0, 3.7.2.1): strip triangle i is (i, i + 1 + i % 2,
// i + 2 - i % 2), fan triangle i is (i + 1, i + 2, 0). Fewer than 3 indices give none.
std::vector<std::uint32_t> listFromStrip(const std::vector<std::uint32_t>& strip);
std::vector<std::uint32_t> listFromFan(const std::vector<std::uint32_t>& fan);

// Gives every corner of every triangle its own vertex, and the face's normal. Tangents are dropped: without normals in
// the file they have no meaning (glTF 2.0, 3.7.2.1). A triangle without area gets +Y.
void makeFlatNormals(Mesh& mesh);

// How many directions of a mesh could not be used.
struct BrokenDirections {
  std::size_t zero = 0, notFinite = 0;
  bool any() const { return zero + notFinite > 0; }
};

// "2 normals of no length and 1 that is NaN or infinite".
std::string describe(const BrokenDirections& broken, const char* what);

// Scales normals to unit length. One that is zero or not finite becomes the mean of its faces' normals, weighted by
// area (+Y where that is zero too). Returns how many were replaced.
BrokenDirections mendNormals(Mesh& mesh);

} // namespace parity::scenes
