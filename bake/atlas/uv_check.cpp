// TEXCOORD_1 is tried at the resolution that the atlas would use.
#include "bake/atlas/uv_check.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include <fmt/format.h>

#include "bake/atlas/raster.h"
#include "bake/encode/occupancy.h"

namespace parity::bake {
namespace {

constexpr double kLeastAreaShare = 1e-3; // of a face: its area in uv by what the mean density gives it
constexpr double kLeastDensity = 0.25;   // of a chart, linear, by the density asked for
constexpr std::uint32_t kNoChart = 0xffffffffu;

// Charts by union of the corners that share place and uv: a number for each face of `flat`, and how many there are.
struct ChartNumbers {
  std::vector<std::uint32_t> ofFace;
  int count = 0;
};

ChartNumbers numberCharts(const scenes::Mesh& mesh, const MeshFaces& faces, const std::vector<std::uint32_t>& subset) {
  std::vector<std::uint32_t> order(3 * subset.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t i) {
    const std::size_t corner = 3 * std::size_t{subset[i / 3]} + i % 3;
    const glm::vec2& uv = mesh.uv1[mesh.indices[corner]];
    return std::tuple(faces.weldedCorners[corner], uv.x, uv.y);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const auto keyA = key(a), keyB = key(b);
    return keyA != keyB ? keyA < keyB : a < b;
  });
  std::vector<std::uint32_t> parent(subset.size());
  std::iota(parent.begin(), parent.end(), 0u);
  const auto rootOf = [&](std::uint32_t face) {
    while (parent[face] != face) face = parent[face] = parent[parent[face]];
    return face;
  };
  for (std::size_t i = 1; i < order.size(); ++i) {
    if (key(order[i]) != key(order[i - 1])) continue;
    const std::uint32_t a = rootOf(order[i] / 3), b = rootOf(order[i - 1] / 3);
    parent[std::max(a, b)] = std::min(a, b);
  }
  ChartNumbers numbers{std::vector<std::uint32_t>(subset.size()), 0};
  for (std::uint32_t face = 0; face < subset.size(); ++face) {
    const std::uint32_t root = rootOf(face); // never behind its face
    numbers.ofFace[face] = root == face ? static_cast<std::uint32_t>(numbers.count++) : numbers.ofFace[root];
  }
  return numbers;
}

// Of the chart with the least texels a unit, by the mean over its area.
double leastDensity(const MeshFaces& faces, const FlatChart& flat, const ChartNumbers& charts) {
  std::vector<double> area(static_cast<std::size_t>(charts.count), 0), texels(area.size(), 0);
  for (std::size_t i = 0; i < flat.faces.size(); ++i) {
    area[charts.ofFace[i]] += faces.areas[flat.faces[i]];
    texels[charts.ofFace[i]] += std::abs(doubleArea(flat.corners[i])) / 2;
  }
  double least = std::numeric_limits<double>::max();
  for (std::size_t chart = 0; chart < area.size(); ++chart)
    least = std::min(least, std::sqrt(texels[chart] / area[chart]));
  return least;
}

bool facesOverlap(const FlatChart& flat) {
  Occupancy taken(flat.size.x * kSubTexels, flat.size.y * kSubTexels);
  for (FlatFace cells : flat.corners) {
    for (glm::dvec2& corner : cells) corner *= kSubTexels;
    if (taken.overlaps(cells)) return true;
    taken.add(cells);
  }
  return false;
}

// Whether there are texels of two charts with fewer than `padding` texels between them.
bool chartsTooClose(const FlatChart& flat, const ChartNumbers& charts, int padding) {
  if (charts.count < 2) return false;
  const int width = flat.size.x, height = flat.size.y;
  std::vector<std::uint32_t> owner(static_cast<std::size_t>(width) * height, kNoChart);
  bool shared = false;
  for (std::size_t i = 0; i < flat.corners.size(); ++i) {
    forEachTouched(flat.corners[i], kTouchSlack, width, height, [&](int x, int begin, int end) {
      for (int y = begin; y < end; ++y) {
        std::uint32_t& texel = owner[static_cast<std::size_t>(y) * width + x];
        shared = shared || (texel != kNoChart && texel != charts.ofFace[i]);
        texel = charts.ofFace[i];
      }
    });
  }
  if (shared) return padding > 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const std::uint32_t here = owner[static_cast<std::size_t>(y) * width + x];
      if (here == kNoChart) continue;
      for (int v = std::max(0, y - padding); v <= std::min(height - 1, y + padding); ++v)
        for (int u = std::max(0, x - padding); u <= std::min(width - 1, x + padding); ++u) {
          const std::uint32_t there = owner[static_cast<std::size_t>(v) * width + u];
          if (there != kNoChart && there != here) return true;
        }
    }
  return false;
}

} // namespace

CheckedUvs checkLightmapUvs(const scenes::Mesh& mesh, const MeshFaces& faces, const LayoutOptions& options) {
  const auto refuse = [](std::string why) { return CheckedUvs{std::move(why), {}, 0}; };
  if (mesh.uv1.empty()) return refuse("no TEXCOORD_1");
  CheckedUvs result;
  FlatChart& flat = result.flat;
  double uvArea = 0;
  for (std::uint32_t face = 0; face < faces.count(); ++face) {
    if (faces.areas[face] == 0) continue;
    FlatFace corners;
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = mesh.uv1[mesh.indices[3 * std::size_t{face} + k]];
      if (!std::isfinite(corners[k].x) || !std::isfinite(corners[k].y)) return refuse("TEXCOORD_1 is not finite");
    }
    uvArea += std::abs(doubleArea(corners)) / 2;
    flat.faces.push_back(face);
    flat.corners.push_back(corners);
  }
  if (!(uvArea > 0)) return refuse("TEXCOORD_1 has no area");
  for (std::size_t i = 0; i < flat.faces.size(); ++i)
    if (std::abs(doubleArea(flat.corners[i])) / 2 < kLeastAreaShare * uvArea * faces.areas[flat.faces[i]] / faces.area)
      return refuse("TEXCOORD_1 has triangles with almost no area");

  const double texelsPerUv = options.texelsPerUnit * std::sqrt(faces.area / uvArea);
  for (FlatFace& corners : flat.corners)
    for (glm::dvec2& corner : corners) corner *= texelsPerUv;
  fitToTexels(flat);
  if (std::max(flat.size.x, flat.size.y) + options.padding > options.maxSide)
    return refuse(fmt::format("TEXCOORD_1 needs {} x {} texels, more than a page", flat.size.x, flat.size.y));
  const ChartNumbers charts = numberCharts(mesh, faces, flat.faces);
  const double least = leastDensity(faces, flat, charts) / options.texelsPerUnit;
  if (least < kLeastDensity)
    return refuse(fmt::format("TEXCOORD_1 is uneven: a chart has {:.2g} of the requested density", least));
  if (facesOverlap(flat)) return refuse("TEXCOORD_1 has triangles that overlap");
  if (chartsTooClose(flat, charts, options.padding))
    return refuse(fmt::format("TEXCOORD_1 has charts less than {} texels apart", options.padding));
  result.charts = charts.count;
  return result;
}

} // namespace parity::bake
