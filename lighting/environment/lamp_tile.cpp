// Lamps filtered into a tile of a level.
#include <algorithm>
#include <array>
#include <cassert>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

#include "lighting/environment/cube.h"
#include "lighting/environment/lamp_steps.h"
#include "lighting/environment/lamp_sums.h"

namespace parity::lighting {

namespace {

// Chebyshev points of [-1, 1]: cos(pi (2 i + 1) / 10).
constexpr std::array kSmoothPoints{0.95105651629515357, 0.58778525229247313, 0.0, -0.58778525229247313,
                                   -0.95105651629515357};
constexpr int kAlong = kSmoothPoints.size(), kPoints = kAlong * kAlong, kPointFours = (kPoints + 3) / 4;
using PointValues = std::array<double, kAlong>;

// Lagrange's polynomials at x: each is 1 at its point and 0 at the others.
PointValues lagrangeAt(double x) {
  PointValues values;
  for (int i = 0; i < kAlong; ++i) {
    values[i] = 1;
    for (int j = 0; j < kAlong; ++j)
      if (j != i) values[i] *= (x - kSmoothPoints[j]) / (kSmoothPoints[i] - kSmoothPoints[j]);
  }
  return values;
}

// The face's coordinate at x in [-1, 1], which goes from the middle of a tile's first texel to that of its last.
double faceCoordinate(int first, const TexelTile& tile, double x) {
  const double texel = first + (tile.side - 1) * (x + 1) / 2;
  return (2 * texel + 1) / tile.faceSize - 1;
}

// The polynomials, of degree 4 in both axes, through the light of some nodes at the Chebyshev points.
void interpolateLamps(const LampTree& tree, float a2, std::vector<std::uint32_t> nodes, const TexelTile& tile,
                      std::span<glm::vec3> sums) {
  std::array<FourLampSums, kPointFours> fours;
  for (int i = 0; i < 4 * kPointFours; ++i) {
    const int point = std::min(i, kPoints - 1);
    const glm::dvec3 direction =
        glm::normalize(directionOf({tile.face, faceCoordinate(tile.left, tile, kSmoothPoints[point % kAlong]),
                                    faceCoordinate(tile.top, tile, kSmoothPoints[point / kAlong])}));
    for (int c = 0; c < 3; ++c) fours[i / 4].direction[c][i % 4] = static_cast<float>(direction[c]);
  }
  addLamps(tree, a2, {.smooth = std::move(nodes), .taken = {}, .walked = {}}, fours);
  std::array<PointValues, kMaxTileSide> weights;
  for (int i = 0; i < tile.side; ++i) weights[i] = lagrangeAt(2.0 * i / (tile.side - 1) - 1);
  for (int x = 0; x < tile.side; ++x) {
    std::array<glm::dvec3, kAlong> column{};
    for (int point = 0; point < kPoints; ++point)
      for (int c = 0; c < 3; ++c)
        column[point / kAlong][c] +=
            weights[x][point % kAlong] * static_cast<double>(fours[point / 4].sum[c][point % 4]);
    for (int y = 0; y < tile.side; ++y) {
      glm::dvec3 sum(0.0);
      for (int point = 0; point < kAlong; ++point) sum += weights[y][point] * column[point];
      sums[y * tile.side + x] += glm::vec3(sum);
    }
  }
}

} // namespace

void addLampsToTile(const LampTree& tree, const TexelTile& tile, std::span<const glm::vec3> normals, float a2,
                    std::span<glm::vec3> sums) {
  assert(tile.side <= kMaxTileSide && (tile.side <= 2 || tile.side % 4 == 0));
  assert(static_cast<int>(normals.size()) == tile.count() && sums.size() == normals.size());
  std::array<FourLampSums, kMaxTileTexels / 4> fours;
  // Squares of four rows: those of one square open the same lamps more often than those of one row.
  const int rows = std::min(tile.side, 4), count = (tile.side + 3) / 4 * tile.side;
  // What is left over of four directions repeats the last of its row.
  const auto texelOf = [&](int four, int lane) {
    const int square = four / rows, across = (tile.side + 3) / 4;
    const int x = square % across * 4 + lane, y = square / across * rows + four % rows;
    return y * tile.side + std::min(x, tile.side - 1);
  };
  for (int four = 0; four < count; ++four)
    for (int lane = 0; lane < 4; ++lane)
      for (int c = 0; c < 3; ++c) fours[four].direction[c][lane] = normals[texelOf(four, lane)][c];
  LampSteps steps = findLampSteps(tree, a2, normals);
  // Interpolation costs kPointFours fours and some more.
  if (count > 2 * kPointFours && !steps.smooth.empty())
    interpolateLamps(tree, a2, std::exchange(steps.smooth, {}), tile, sums);
  addLamps(tree, a2, steps, std::span(fours).first(count));
  for (int four = 0; four < count; ++four)
    for (int lane = 0; lane < std::min(4, tile.side); ++lane)
      for (int c = 0; c < 3; ++c) sums[texelOf(four, lane)][c] += fours[four].sum[c][lane];
}

} // namespace parity::lighting
