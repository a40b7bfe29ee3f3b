#include "external/rotation_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "external/angles.h"

namespace parity::external {

namespace {

using Matrix4 = std::array<std::array<double, 4>, 4>;

// The eigenvector of the largest eigenvalue, by Jacobi's rotations.
std::array<double, 4> largestEigenvector(Matrix4 m) {
  Matrix4 v{};
  for (std::size_t i = 0; i < 4; ++i) v[i][i] = 1;
  for (int sweep = 0; sweep < 50; ++sweep)
    for (std::size_t p = 0; p < 4; ++p)
      for (std::size_t q = p + 1; q < 4; ++q) {
        if (std::abs(m[p][q]) < 1e-18) continue;
        const double theta = 0.5 * std::atan2(2 * m[p][q], m[q][q] - m[p][p]), c = std::cos(theta), s = std::sin(theta);
        for (std::size_t k = 0; k < 4; ++k) {
          const double a = m[k][p], b = m[k][q];
          m[k][p] = c * a - s * b, m[k][q] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double a = m[p][k], b = m[q][k];
          m[p][k] = c * a - s * b, m[q][k] = s * a + c * b;
        }
        for (std::size_t k = 0; k < 4; ++k) {
          const double a = v[k][p], b = v[k][q];
          v[k][p] = c * a - s * b, v[k][q] = s * a + c * b;
        }
      }
  std::size_t best = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (m[i][i] > m[best][best]) best = i;
  return {v[0][best], v[1][best], v[2][best], v[3][best]};
}

} // namespace

RotationFit fitRotation(const std::vector<glm::dvec3>& from, const std::vector<glm::dvec3>& to) {
  glm::dmat3 b(0.0); // b[column][row]: sum of to * transpose(from)
  for (std::size_t i = 0; i < from.size(); ++i) b += glm::outerProduct(to[i], from[i]);
  const auto at = [&](int row, int column) { return b[column][row]; };
  const double trace = at(0, 0) + at(1, 1) + at(2, 2);
  // Of the quaternion (w, x, y, z) that turns `from` into `to`.
  const double zx = at(2, 1) - at(1, 2), zy = at(0, 2) - at(2, 0), zz = at(1, 0) - at(0, 1);
  const Matrix4 k = {{{trace, zx, zy, zz},
                      {zx, 2 * at(0, 0) - trace, at(0, 1) + at(1, 0), at(0, 2) + at(2, 0)},
                      {zy, at(0, 1) + at(1, 0), 2 * at(1, 1) - trace, at(1, 2) + at(2, 1)},
                      {zz, at(0, 2) + at(2, 0), at(1, 2) + at(2, 1), 2 * at(2, 2) - trace}}};
  const auto [w, x, y, z] = largestEigenvector(k);
  RotationFit fit;
  fit.rotation = glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y), // columns
                            2 * (x * y - w * z), 1 - 2 * (x * x + z * z), 2 * (y * z + w * x), //
                            2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y));
  fit.angleDeg = 2 * std::acos(std::min(std::abs(w), 1.0)) / kDegree;
  double square = 0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const double angle = std::acos(std::clamp(glm::dot(fit.rotation * from[i], to[i]), -1.0, 1.0)) / kDegree;
    square += angle * angle / static_cast<double>(from.size());
  }
  fit.errorDeg = std::sqrt(square);
  return fit;
}

} // namespace parity::external
