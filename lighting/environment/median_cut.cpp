#include "lighting/environment/median_cut.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <queue>

#include "scenes/luminance.h"

namespace parity::lighting {

namespace {

using std::numbers::pi;
constexpr double kSolidAngleShare = 0.3; // of a part's weight
constexpr int kMaxRows = 256;            // of the grid that is cut, and twice as many columns

// Sums over a cell of the grid or a part of it.
struct Sum {
  glm::dvec3 light{0.0}, direction{0.0}; // direction: weighted by the luminance of the light
  double weight = 0;
  void add(const Sum& other) {
    light += other.light;
    direction += other.direction;
    weight += other.weight;
  }
};

struct Grid {
  int width = 0, height = 0;
  std::vector<Sum> cells;
  const Sum& at(int x, int y) const { return cells[static_cast<std::size_t>(y) * width + x]; }
};

Grid gather(const PanoramaCells& panorama) {
  int mip = 0;
  while (mip + 1 < static_cast<int>(panorama.mips.size()) && heightOf(panorama, mip) > kMaxRows) ++mip;
  const int width = widthOf(panorama, mip), height = heightOf(panorama, mip);
  Grid grid{std::min(width, 2 * kMaxRows), std::min(height, kMaxRows), {}};
  grid.cells.resize(static_cast<std::size_t>(grid.width) * grid.height);
  double luminance = 0;
  std::vector<double> solidAngles(grid.cells.size());
  for (int y = 0; y < height; ++y) {
    const double upper = std::cos(pi * y / height), lower = std::cos(pi * (y + 1) / height),
                 cosine = 0.5 * (upper + lower), sine = std::sqrt(1 - cosine * cosine),
                 solidAngle = (upper - lower) * 2 * pi / width;
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 light = glm::dvec3(panorama.mips[mip][static_cast<std::size_t>(y) * width + x]) * solidAngle;
      const double azimuth = ((x + 0.5) / width - panorama.turns - 0.5) * 2 * pi, Y = scenes::luminanceOf(light);
      const std::size_t i = static_cast<std::size_t>(y * grid.height / height) * grid.width + x * grid.width / width;
      grid.cells[i].light += light;
      grid.cells[i].direction += Y * glm::dvec3(sine * std::cos(azimuth), cosine, sine * std::sin(azimuth));
      solidAngles[i] += solidAngle;
      luminance += Y;
    }
  }
  for (std::size_t i = 0; i < grid.cells.size(); ++i) {
    const double share = luminance > 0 ? scenes::luminanceOf(grid.cells[i].light) / luminance : 0;
    grid.cells[i].weight = (1 - kSolidAngleShare) * share + kSolidAngleShare * solidAngles[i] / (4 * pi);
  }
  return grid;
}

// Columns [x0, x1) of rows [y0, y1).
struct Part {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  double weight = 0;
  std::size_t number = 0; // in the order in which they were made: of equal weights the first goes before
  bool isCell() const { return x1 - x0 == 1 && y1 - y0 == 1; }
  bool operator<(const Part& other) const {
    if (isCell() != other.isCell()) return isCell();
    return weight != other.weight ? weight < other.weight : number > other.number;
  }
};

// The two halves of a part, cut across its longer side where they weigh about the same.
std::pair<Part, Part> cut(const Grid& grid, const Part& part) {
  const double rows = pi * (part.y1 - part.y0) / grid.height,
               columns =
                   2 * pi * (part.x1 - part.x0) / grid.width * std::sin(pi * 0.5 * (part.y0 + part.y1) / grid.height);
  const bool acrossColumns = part.y1 - part.y0 == 1 || (part.x1 - part.x0 > 1 && columns >= rows);
  const int begin = acrossColumns ? part.x0 : part.y0, end = acrossColumns ? part.x1 : part.y1;
  double below = 0;
  int at = begin;
  do {
    if (acrossColumns)
      for (int y = part.y0; y < part.y1; ++y) below += grid.at(at, y).weight;
    else
      for (int x = part.x0; x < part.x1; ++x) below += grid.at(x, at).weight;
    ++at;
  } while (at < end - 1 && below < 0.5 * part.weight);
  Part first = part, second = part;
  (acrossColumns ? first.x1 : first.y1) = at;
  (acrossColumns ? second.x0 : second.y0) = at;
  first.weight = below;
  second.weight = part.weight - below;
  return {first, second};
}

EnvironmentPoint pointOf(const Grid& grid, const Part& part) {
  Sum sum;
  for (int y = part.y0; y < part.y1; ++y)
    for (int x = part.x0; x < part.x1; ++x) sum.add(grid.at(x, y));
  const double length = glm::length(sum.direction);
  EnvironmentPoint point;
  if (length > 0) point.direction = glm::vec3(sum.direction / length);
  point.light = glm::vec3(sum.light);
  return point;
}

} // namespace

std::vector<EnvironmentPoint> cutEnvironment(const PanoramaCells& cells, int count) {
  assert(count >= 1 && !cells.mips.empty());
  const Grid grid = gather(cells);
  std::priority_queue<Part> parts;
  parts.push({.x0 = 0, .x1 = grid.width, .y0 = 0, .y1 = grid.height, .weight = 1, .number = 0});
  for (std::size_t number = 1; parts.size() < static_cast<std::size_t>(count) && !parts.top().isCell(); number += 2) {
    auto [first, second] = cut(grid, parts.top());
    parts.pop();
    first.number = number;
    second.number = number + 1;
    parts.push(first);
    parts.push(second);
  }
  std::vector<EnvironmentPoint> points;
  for (; !parts.empty(); parts.pop()) points.push_back(pointOf(grid, parts.top()));
  return points;
}

} // namespace parity::lighting
