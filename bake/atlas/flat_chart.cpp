// Projection of charts, and their division where one rectangle does not serve.
#include "bake/atlas/flat_chart.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "bake/atlas/raster.h"
#include "bake/encode/occupancy.h"
#include "base/error.h"

namespace parity::bake {
namespace {

constexpr std::size_t kMaxHullEdges = 64;
constexpr double kSqueeze = 1e-3;   // texels by which a chart may be squeezed to fit a whole number of them
constexpr double kManyTexels = 1e9; // more than any page has, and still an int

double crossOf(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// A. M. Andrew, "Another Efficient Algorithm for Convex Hulls in Two Dimensions", 1979.
std::vector<glm::dvec2> convexHull(std::vector<glm::dvec2> points) {
  const auto before = [](const glm::dvec2& a, const glm::dvec2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<glm::dvec2> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const glm::dvec2& point : points) {
      while (hull.size() >= begin + 2 && crossOf(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0)
        hull.pop_back();
      hull.push_back(point);
    }
    hull.pop_back(); // it begins the other side
    std::reverse(points.begin(), points.end());
  }
  return hull;
}

struct Box {
  glm::dvec2 lower{std::numeric_limits<double>::max()}, upper{std::numeric_limits<double>::lowest()};
  void add(const glm::dvec2& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  glm::dvec2 size() const { return upper - lower; }
};

glm::dvec2 turned(const glm::dvec2& p, const glm::dvec2& axis) {
  return {glm::dot(p, axis), p.y * axis.x - p.x * axis.y};
}

Box boundsOf(const FlatChart& chart) {
  Box box;
  for (const FlatFace& face : chart.corners)
    for (const glm::dvec2& corner : face) box.add(corner);
  return box;
}

// The faces, in their order, that lie over none before them; and the rest.
std::array<std::vector<std::uint32_t>, 2> separateOverlaps(const FlatChart& flat) {
  Occupancy taken(flat.size.x * kSubTexels, flat.size.y * kSubTexels);
  std::vector<std::uint32_t> kept, rest;
  for (std::size_t i = 0; i < flat.faces.size(); ++i) {
    FlatFace cells = flat.corners[i];
    for (glm::dvec2& corner : cells) corner *= kSubTexels;
    if (taken.overlaps(cells)) {
      rest.push_back(flat.faces[i]);
      continue;
    }
    taken.add(cells);
    kept.push_back(flat.faces[i]);
  }
  return {std::move(kept), std::move(rest)};
}

double costOf(const FlatChart& flat, int padding) {
  return static_cast<double>(flat.size.x + padding) * (flat.size.y + padding);
}

double filledArea(const FlatChart& flat) {
  double area = 0;
  for (const FlatFace& face : flat.corners) area += std::abs(doubleArea(face)) / 2;
  return area;
}

// The chart cut across the middle of the axes of its rectangle that `cutsX` and `cutsY` name, in connected parts.
std::vector<Chart> cut(const MeshFaces& faces, const Chart& chart, const FlatChart& flat, bool cutsX, bool cutsY) {
  std::array<std::vector<std::uint32_t>, 4> sides;
  for (std::size_t i = 0; i < flat.faces.size(); ++i) {
    const FlatFace& face = flat.corners[i];
    const glm::dvec2 middle = (face[0] + face[1] + face[2]) / 3.0;
    const bool right = cutsX && middle.x > 0.5 * flat.size.x, below = cutsY && middle.y > 0.5 * flat.size.y;
    sides[(right ? 1u : 0u) + (below ? 2u : 0u)].push_back(flat.faces[i]);
  }
  std::vector<Chart> parts;
  for (const std::vector<std::uint32_t>& side : sides)
    for (std::vector<std::uint32_t>& part : connectedParts(faces, side))
      parts.push_back({chart.normal, std::move(part)});
  return parts;
}

// Halves or quarters of a chart that fills little of its rectangle; empty where that saves too little.
std::vector<Chart> cutLoose(const scenes::Mesh& mesh, const MeshFaces& faces, const Chart& chart, const FlatChart& flat,
                            double texelsPerUnit, int padding) {
  constexpr double kFillWanted = 0.55, kSavingWanted = 0.75;
  constexpr int kLeastSide = 12; // texels: smaller ones save nothing that their padding does not cost
  if (std::max(flat.size.x, flat.size.y) < kLeastSide || chart.faces.size() < 2) return {};
  if (filledArea(flat) > kFillWanted * costOf(flat, padding)) return {};
  double leastCost = kSavingWanted * costOf(flat, padding);
  std::vector<Chart> best;
  const bool isWide = flat.size.x >= flat.size.y;
  for (const bool cutsBoth : {false, true}) {
    std::vector<Chart> parts = cut(faces, chart, flat, isWide || cutsBoth, !isWide || cutsBoth);
    double cost = 0;
    for (const Chart& part : parts) cost += costOf(projectChart(mesh, faces, part, texelsPerUnit), padding);
    if (parts.size() < 2 || cost > leastCost) continue;
    leastCost = cost;
    best = std::move(parts);
  }
  return best;
}

[[noreturn]] void throwTooLarge(const scenes::Mesh& mesh, const glm::ivec2& size, int maxSide) {
  throw base::fileError(
      mesh.name, "",
      fmt::format("a part of its surface needs {} x {} texels, but a lightmap page has at most {} a side; lower "
                  "--texels-per-metre or split the mesh",
                  size.x, size.y, maxSide));
}

} // namespace

glm::dvec2 tightestDirection(std::vector<glm::dvec2> points) {
  const std::vector<glm::dvec2> hull = convexHull(std::move(points));
  std::vector<glm::dvec2> edges;
  for (std::size_t i = 0; i < hull.size(); ++i) edges.push_back(hull[(i + 1) % hull.size()] - hull[i]);
  std::stable_sort(edges.begin(), edges.end(),
                   [](const glm::dvec2& a, const glm::dvec2& b) { return glm::dot(a, a) > glm::dot(b, b); });
  if (edges.size() > kMaxHullEdges) edges.resize(kMaxHullEdges);
  glm::dvec2 best(1, 0);
  double bestArea = std::numeric_limits<double>::max();
  for (const glm::dvec2& edge : edges) {
    const double length = glm::length(edge);
    if (length == 0) continue;
    const glm::dvec2 axis = edge / length;
    Box box;
    for (const glm::dvec2& p : hull) box.add(turned(p, axis));
    const glm::dvec2 size = box.size();
    if (size.x * size.y >= bestArea * (1 - 1e-9)) continue;
    bestArea = size.x * size.y;
    best = size.x >= size.y ? axis : glm::dvec2(-axis.y, axis.x);
  }
  return best;
}

void fitToTexels(FlatChart& chart) {
  const Box box = boundsOf(chart);
  const glm::dvec2 extent = box.size();
  glm::dvec2 scale(1);
  for (int axis = 0; axis < 2; ++axis) {
    chart.size[axis] = static_cast<int>(std::clamp(std::ceil(extent[axis] - kSqueeze), 1.0, kManyTexels));
    if (extent[axis] > 0) scale[axis] = chart.size[axis] / extent[axis];
  }
  for (FlatFace& face : chart.corners)
    for (glm::dvec2& corner : face) corner = (corner - box.lower) * scale;
}

FlatChart projectChart(const scenes::Mesh& mesh, const MeshFaces& faces, const Chart& chart, double texelsPerUnit) {
  const glm::dvec3 side = std::abs(chart.normal.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 right = glm::normalize(glm::cross(side, chart.normal)), down = -glm::cross(chart.normal, right);
  FlatChart flat;
  flat.faces = chart.faces;
  flat.corners.resize(chart.faces.size());
  std::vector<glm::dvec2> points;
  points.reserve(3 * chart.faces.size());
  double area = 0;
  for (std::size_t i = 0; i < chart.faces.size(); ++i) {
    area += faces.areas[chart.faces[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const glm::dvec3 p = mesh.positions[mesh.indices[3 * std::size_t{chart.faces[i]} + k]];
      flat.corners[i][k] = {glm::dot(p, right), glm::dot(p, down)};
      points.push_back(flat.corners[i][k]);
    }
  }
  const glm::dvec2 axis = tightestDirection(std::move(points));
  const double projected = filledArea(flat);
  // What foreshortening takes from the chart's area is given back; to a needle that is next to nothing, not.
  const double scale = texelsPerUnit * std::min(2.0, projected > 0 ? std::sqrt(area / projected) : 1.0);
  for (FlatFace& face : flat.corners)
    for (glm::dvec2& corner : face) corner = scale * turned(corner, axis);
  fitToTexels(flat);
  return flat;
}

std::vector<FlatChart> flattenChart(const scenes::Mesh& mesh, const MeshFaces& faces, const Chart& chart,
                                    double texelsPerUnit, int padding, int maxSide) {
  std::vector<FlatChart> done;
  std::vector<Chart> open{chart};
  while (!open.empty()) {
    const Chart next = std::move(open.back());
    open.pop_back();
    FlatChart flat = projectChart(mesh, faces, next, texelsPerUnit);
    std::vector<Chart> parts = cutLoose(mesh, faces, next, flat, texelsPerUnit, padding);
    if (!parts.empty()) {
      std::move(parts.begin(), parts.end(), std::back_inserter(open));
      continue;
    }
    if (std::max(flat.size.x, flat.size.y) > maxSide) throwTooLarge(mesh, flat.size, maxSide);
    if (separateOverlaps(flat)[1].empty()) {
      done.push_back(std::move(flat));
      continue;
    }
    // From neighbour to neighbour, so that what is kept is of one piece; both are then laid out anew.
    std::vector<std::uint32_t> inOrder;
    for (const std::vector<std::uint32_t>& part : connectedParts(faces, next.faces))
      inOrder.insert(inOrder.end(), part.begin(), part.end());
    const FlatChart again = projectChart(mesh, faces, {next.normal, std::move(inOrder)}, texelsPerUnit);
    for (const std::vector<std::uint32_t>& subset : separateOverlaps(again))
      for (std::vector<std::uint32_t>& part : connectedParts(faces, subset))
        open.push_back({next.normal, std::move(part)});
  }
  return done;
}

} // namespace parity::bake
