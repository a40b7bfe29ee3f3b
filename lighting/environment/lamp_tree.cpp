// The bright part of an environment as a tree of lights.
#include "lighting/environment/lamp_tree.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <span>
#include <utility>

#include "base/parallel.h"
#include "scenes/luminance.h"

namespace parity::lighting {

namespace {

using scenes::luminanceOf;

// What a cell of the panorama has above the mean.
struct Cell {
  glm::dvec3 direction, light; // radiance times solid angle
  double luminance;            // of light
  double spread;               // of the cell itself, a rectangle
};

constexpr double kCompactSpread = 3e-5; // (.31 degrees)^2
constexpr double kAround = 4, kShareOfAround = 0.7;

// Directions of the middles of a panorama's cells, by column and row.
class CellDirections {
public:
  explicit CellDirections(const Panorama& p) {
    for (int x = 0; x < p.width; ++x) {
      const double azimuth = p.azimuthAt(x + 0.5);
      m_columns.emplace_back(std::cos(azimuth), std::sin(azimuth));
    }
    for (int y = 0; y < p.height; ++y) {
      const double height = (p.rowY[y] + p.rowY[y + 1]) / 2;
      m_rows.emplace_back(std::sqrt(1 - height * height), height);
    }
  }
  glm::dvec3 at(int x, int y) const {
    const glm::dvec2 &column = m_columns[x], &row = m_rows[y];
    return {row.x * column.x, row.y, row.x * column.y};
  }
  double across(int y) const { return m_rows[y].x; }

private:
  std::vector<glm::dvec2> m_columns, m_rows; // cos and sin of the azimuth; sin and cos of the polar angle
};

// lights: of each cell of the panorama, as it lies there, the luminance of what is taken.
std::vector<Cell> takeCells(Panorama& p, const CellDirections& directions, std::vector<float>& lights) {
  lights.assign(p.columns.size(), 0.f);
  const double columnWidth = 2 * std::numbers::pi / p.width, rowHeight = std::numbers::pi / p.height;
  double mean = 0;
  for (int x = 0; x < p.width; ++x)
    for (int y = 0; y < p.height; ++y)
      mean += luminanceOf(p.column(x)[y]) * (p.rowY[y] - p.rowY[y + 1]) * columnWidth / (4 * std::numbers::pi);
  std::vector<Cell> cells;
  for (int x = 0; x < p.width; ++x)
    for (int y = 0; y < p.height; ++y) {
      glm::vec3& radiance = p.columns[static_cast<std::size_t>(x) * p.height + y];
      const double luminance = luminanceOf(radiance);
      if (!(luminance > mean)) continue;
      const glm::vec3 rest(glm::dvec3(radiance) * (mean / luminance));
      const double solidAngle = (p.rowY[y] - p.rowY[y + 1]) * columnWidth;
      const glm::dvec3 light = solidAngle * (glm::dvec3(radiance) - glm::dvec3(rest));
      cells.push_back({directions.at(x, y), light, luminanceOf(light),
                       (std::pow(columnWidth * directions.across(y), 2) + rowHeight * rowHeight) / 12});
      lights[static_cast<std::size_t>(x) * p.height + y] = static_cast<float>(cells.back().luminance);
      radiance = rest;
    }
  std::erase_if(cells, [](const Cell& cell) { return !(cell.luminance > 0); }); // above the mean by rounding alone
  return cells;
}

// Moments of some cells' light.
struct Moments {
  glm::dvec3 light{0.0}, mean{0.0}, axis{0.0}; // centroid; unit, along which they are spread most
  double luminance = 0, spread = 0;
};

Moments momentsOf(std::span<const Cell> cells) {
  Moments m;
  for (const Cell& cell : cells) {
    m.light += cell.light;
    m.luminance += cell.luminance;
    m.mean += cell.luminance * cell.direction;
    m.spread += cell.luminance * cell.spread;
  }
  m.mean /= m.luminance;
  m.spread /= m.luminance;
  glm::dmat3 covariance(0.0);
  for (const Cell& cell : cells) {
    const glm::dvec3 d = cell.direction - m.mean;
    covariance += cell.luminance / m.luminance * glm::outerProduct(d, d);
  }
  m.spread += covariance[0][0] + covariance[1][1] + covariance[2][2];
  // No cell is farther away than twice the root of it.
  for (const Cell& cell : cells) {
    const glm::dvec3 d = cell.direction - m.mean;
    m.spread = std::max(m.spread, glm::dot(d, d) / 4);
  }
  // The power method. It need not converge: any axis along which they are spread does.
  m.axis = {0.267, 0.535, 0.802};
  for (int i = 0; i < 12; ++i) {
    const glm::dvec3 turned = covariance * m.axis;
    const double length = glm::length(turned);
    if (!(length > 1e-30)) break;
    m.axis = turned / length;
  }
  return m;
}

// Lamps that face each other may have none: then any direction, as their spread is near 1 and they are divided.
glm::dvec3 directionOf(const Moments& m) {
  const double length = glm::length(m.mean);
  return length > 1e-6 ? m.mean / length : m.axis;
}

// The tree of some cells has 2 n - 1 nodes: where each part of it lies is known before it is made.
void makeNodes(std::span<Cell> cells, std::span<LampNode> nodes, std::size_t index) {
  const Moments m = momentsOf(cells);
  nodes[index] = {.direction = glm::vec3(directionOf(m)),
                  .spread = static_cast<float>(m.spread),
                  .light = glm::vec3(m.light),
                  .next = static_cast<std::uint32_t>(index + 2 * cells.size() - 1)};
  if (cells.size() > 1) {
    const double middle = glm::dot(m.axis, m.mean);
    const auto isBefore = [&](const Cell& cell) { return glm::dot(m.axis, cell.direction) < middle; };
    auto split = std::stable_partition(cells.begin(), cells.end(), isBefore);
    if (split == cells.begin() || split == cells.end()) split = cells.begin() + cells.size() / 2; // all in one place
    const std::span<Cell> first(cells.begin(), split), second(split, cells.end());
    const auto makeHalf = [&](std::size_t half) {
      if (half == 0)
        makeNodes(first, nodes, index + 1);
      else
        makeNodes(second, nodes, index + 2 * first.size());
    };
    constexpr std::size_t kWorthAThread = 2000; // cells
    if (cells.size() >= kWorthAThread)
      return base::parallelFor(2, 1, [&](std::size_t half, std::size_t) { makeHalf(half); });
    makeHalf(0);
    makeHalf(1);
  }
}

// Leaves are the cells, which are brought into their order.
LampTree makeTree(std::span<Cell> cells) {
  LampTree tree;
  if (cells.empty()) return tree;
  tree.nodes.resize(2 * cells.size() - 1);
  makeNodes(cells, tree.nodes, 0);
  return tree;
}

double lightOf(const LampNode& node) { return luminanceOf(node.light); }

// The lamps' cells, as they lie in the panorama.
struct LampMap {
  const Panorama& panorama;
  CellDirections directions;
  std::vector<float> lights;
};

// Light (luminance) of the cells whose middles are within `radius` of a direction. Any sum above `enough` may be cut
// short.
double lightWithin(const LampMap& map, const glm::dvec3& direction, double radius, double enough) {
  const Panorama& p = map.panorama;
  const double polar = std::acos(std::clamp(direction.y, -1.0, 1.0)),
               column = p.columnAt(std::atan2(direction.z, direction.x));
  const double cosine = std::cos(radius),
               across = std::sin(polar) > 2 * radius ? std::asin(std::sin(radius) / std::sin(polar)) : 4.0;
  const double columns = std::min(across / (2 * std::numbers::pi) * p.width + 1, p.width / 2.0);
  const int top = std::max(0, static_cast<int>((polar - radius) / std::numbers::pi * p.height)),
            bottom = std::min(p.height - 1, static_cast<int>((polar + radius) / std::numbers::pi * p.height)),
            left = static_cast<int>(std::floor(column - columns)),
            right = left + std::min(p.width, static_cast<int>(2 * columns) + 2);
  double sum = 0;
  for (int i = left; i < right && sum <= enough; ++i) {
    const int x = (i % p.width + p.width) % p.width;
    for (int y = top; y <= bottom; ++y)
      if (glm::dot(direction, map.directions.at(x, y)) >= cosine)
        sum += map.lights[static_cast<std::size_t>(x) * p.height + y];
  }
  return sum;
}

// Whether a node has enough of the light around it.
bool standsAlone(const LampNode& node, const LampMap& map) {
  const double light = lightOf(node);
  // A sum of more than this is too much, by more than rounding.
  const double enough = light / kShareOfAround * (1 + 1e-9);
  return light >= kShareOfAround * lightWithin(map, node.direction, kAround * std::sqrt(double{node.spread}), enough);
}

// The compact groups, from the first on.
std::vector<std::uint32_t> findCompact(const LampTree& tree, const LampMap& map) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < tree.nodes.size();) {
    const LampNode& node = tree.nodes[i];
    const bool isCompact = node.spread <= kCompactSpread && standsAlone(node, map);
    if (isCompact) found.push_back(i);
    i = isCompact ? node.next : i + 1;
  }
  if (found.size() <= kMaxCompactLamps) return found;
  std::ranges::stable_sort(found, std::greater(), [&](std::uint32_t i) { return lightOf(tree.nodes[i]); });
  found.resize(kMaxCompactLamps);
  std::ranges::sort(found);
  return found;
}

} // namespace

Lamps takeLamps(Panorama& panorama) {
  LampMap map{panorama, CellDirections(panorama), {}};
  std::vector<Cell> cells = takeCells(panorama, map.directions, map.lights);
  Lamps lamps;
  lamps.wide = makeTree(cells);
  const std::vector<std::uint32_t> compact = findCompact(lamps.wide, map);
  if (compact.empty()) return lamps;
  // The cells lie in the order of the tree's leaves.
  std::vector<Cell> groups, rest;
  std::size_t leaf = 0, group = 0;
  for (std::size_t i = 0; i < lamps.wide.nodes.size();) {
    const LampNode& node = lamps.wide.nodes[i];
    if (group < compact.size() && compact[group] == i) {
      const std::size_t count = (node.next - i + 1) / 2;
      const Moments m = momentsOf({cells.data() + leaf, count});
      groups.push_back({directionOf(m), m.light, m.luminance, m.spread});
      leaf += count;
      ++group;
      i = node.next;
      continue;
    }
    if (lamps.wide.isLeaf(i)) rest.push_back(cells[leaf++]);
    ++i;
  }
  lamps.wide = makeTree(rest);
  lamps.compact = makeTree(groups);
  return lamps;
}

LampTree pruneLamps(const LampTree& tree, std::size_t leaves) {
  LampTree pruned;
  if (tree.nodes.empty()) return pruned;
  const auto lessUrgent = [&](std::uint32_t a, std::uint32_t b) {
    const auto urgency = [&](std::uint32_t i) {
      return luminanceOf(tree.nodes[i].light) * static_cast<double>(tree.nodes[i].spread);
    };
    return std::pair(urgency(a), b) < std::pair(urgency(b), a);
  };
  std::priority_queue<std::uint32_t, std::vector<std::uint32_t>, decltype(lessUrgent)> queue(lessUrgent);
  std::vector<bool> isDivided(tree.nodes.size(), false);
  queue.push(0);
  std::size_t count = 1;
  while (count < leaves && !queue.empty()) {
    const std::uint32_t node = queue.top();
    queue.pop();
    if (tree.isLeaf(node)) continue;
    isDivided[node] = true;
    queue.push(node + 1);
    queue.push(tree.nodes[node + 1].next);
    ++count;
  }
  const auto add = [&](const auto& self, std::uint32_t node, float spreadAbove) -> void {
    const float spread = tree.nodes[node].spread;
    const bool isKept = !isDivided[node] || node == 0 || 4 * spread < spreadAbove;
    const std::size_t index = pruned.nodes.size();
    if (isKept) pruned.nodes.push_back(tree.nodes[node]);
    if (isDivided[node]) {
      self(self, node + 1, isKept ? spread : spreadAbove);
      self(self, tree.nodes[node + 1].next, isKept ? spread : spreadAbove);
    }
    if (isKept) pruned.nodes[index].next = static_cast<std::uint32_t>(pruned.nodes.size());
  };
  add(add, 0, 0.f);
  return pruned;
}

} // namespace parity::lighting
