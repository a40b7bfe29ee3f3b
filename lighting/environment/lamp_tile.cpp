// Lamps filtered into a tile of a level.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <utility>
#include <vector>

#include "lighting/environment/lamp_sums.h"

namespace parity::lighting {

namespace {

constexpr int kSmoothPoints = 5; // along each axis
constexpr int kPoints = kSmoothPoints * kSmoothPoints, kPointFours = (kPoints + 3) / 4;
using PointValues = std::array<double, kSmoothPoints>;

// Chebyshev points of [-1, 1].
const PointValues& smoothPoints() {
  static const auto points = [] {
    PointValues made;
    for (int i = 0; i < kSmoothPoints; ++i) made[i] = std::cos(std::numbers::pi * (2 * i + 1) / (2 * kSmoothPoints));
    return made;
  }();
  return points;
}

// Lagrange's polynomials at x: each is 1 at its point and 0 at the others.
PointValues lagrangeAt(double x) {
  const PointValues& points = smoothPoints();
  PointValues values;
  for (int i = 0; i < kSmoothPoints; ++i) {
    values[i] = 1;
    for (int j = 0; j < kSmoothPoints; ++j)
      if (j != i) values[i] *= (x - points[j]) / (points[i] - points[j]);
  }
  return values;
}

// The face's coordinate at x in [-1, 1], which goes from the middle of a tile's first texel to that of its last.
double faceCoordinate(int first, int side, double x, int faceSize) {
  const double texel = first + (side - 1) * (x + 1) / 2;
  return (2 * texel + 1) / faceSize - 1;
}

// The polynomials, of degree 4 in both axes, through the light of some nodes at the Chebyshev points.
void interpolateLamps(const LampTree& tree, float a2, std::vector<std::uint32_t> nodes, const TexelTile& tile,
                      std::span<glm::vec3> sums) {
  std::array<FourLampSums, kPointFours> fours;
  for (int i = 0; i < 4 * kPointFours; ++i) {
    const int point = std::min(i, kPoints - 1);
    const glm::dvec3 direction = glm::normalize(directionOf(
        {tile.face, faceCoordinate(tile.left, tile.side, smoothPoints()[point % kSmoothPoints], tile.faceSize),
         faceCoordinate(tile.top, tile.side, smoothPoints()[point / kSmoothPoints], tile.faceSize)}));
    for (int c = 0; c < 3; ++c) fours[i / 4].direction[c][i % 4] = static_cast<float>(direction[c]);
  }
  addLamps(tree, a2, {.smooth = {}, .taken = std::move(nodes), .walked = {}}, fours);
  std::array<PointValues, kMaxTileSide> weights;
  for (int i = 0; i < tile.side; ++i) weights[i] = lagrangeAt(2.0 * i / (tile.side - 1) - 1);
  for (int x = 0; x < tile.side; ++x) {
    std::array<glm::dvec3, kSmoothPoints> column{};
    for (int point = 0; point < kPoints; ++point)
      for (int c = 0; c < 3; ++c)
        column[point / kSmoothPoints][c] +=
            weights[x][point % kSmoothPoints] * static_cast<double>(fours[point / 4].sum[c][point % 4]);
    for (int y = 0; y < tile.side; ++y) {
      glm::dvec3 sum(0.0);
      for (int point = 0; point < kSmoothPoints; ++point) sum += weights[y][point] * column[point];
      sums[y * tile.side + x] += glm::vec3(sum);
    }
  }
}

} // namespace

void addLampsToTile(const LampTree& tree, const TexelTile& tile, std::span<const glm::vec3> normals, float a2,
                    std::span<glm::vec3> sums) {
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
  if (count > 2 * kPointFours) interpolateLamps(tree, a2, std::exchange(steps.smooth, {}), tile, sums);
  addLamps(tree, a2, steps, std::span(fours).first(count));
  for (int four = 0; four < count; ++four)
    for (int lane = 0; lane < std::min(4, tile.side); ++lane)
      for (int c = 0; c < 3; ++c) sums[texelOf(four, lane)][c] += fours[four].sum[c][lane];
}

} // namespace parity::lighting
