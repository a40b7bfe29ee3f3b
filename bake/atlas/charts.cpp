// Charts by clusters of normals.
#include "bake/atlas/charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <queue>
#include <tuple>
#include <unordered_map>

#include <glm/gtc/constants.hpp>

namespace parity::bake {
namespace {

constexpr double kFlatAngleDeg = 2;
constexpr int kRounds = 2;
constexpr std::uint32_t kNoLabel = 0xffffffffu;

double cosineOf(double degrees) { return std::cos(degrees * glm::pi<double>() / 180); }

// Labels of faces (kNoLabel: none), each with the unit normal that its faces are measured by.
struct Labels {
  std::vector<std::uint32_t> of;
  std::vector<glm::dvec3> normals;
  std::vector<std::uint32_t> seeds; // a face of each

  // Spreads a new label from `seed` over faces without one, as far as their normals are within the cosine of `normal`.
  void grow(const MeshFaces& faces, std::uint32_t seed, const glm::dvec3& normal, double leastCosine) {
    const auto label = static_cast<std::uint32_t>(normals.size());
    normals.push_back(normal);
    seeds.push_back(seed);
    std::vector<std::uint32_t> open{seed};
    of[seed] = label;
    while (!open.empty()) {
      const std::uint32_t face = open.back();
      open.pop_back();
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = faces.neighbours[3 * std::size_t{face} + k];
        if (next == kNoFace || of[next] != kNoLabel || glm::dot(faces.normals[next], normal) < leastCosine) continue;
        of[next] = label;
        open.push_back(next);
      }
    }
  }
};

std::vector<double> areasOf(const MeshFaces& faces, const Labels& labels) {
  std::vector<double> areas(labels.normals.size(), 0);
  for (std::size_t face = 0; face < faces.count(); ++face)
    if (labels.of[face] != kNoLabel) areas[labels.of[face]] += faces.areas[face];
  return areas;
}

// The largest first; ties by number.
std::vector<std::uint32_t> byArea(const std::vector<double>& areas) {
  std::vector<std::uint32_t> order(areas.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return areas[a] > areas[b]; });
  return order;
}

// Regions within kFlatAngleDeg of their largest face.
Labels flatRegions(const MeshFaces& faces) {
  Labels regions{std::vector<std::uint32_t>(faces.count(), kNoLabel), {}, {}};
  const double leastCosine = cosineOf(kFlatAngleDeg);
  for (const std::uint32_t face : byArea(faces.areas))
    if (faces.areas[face] > 0 && regions.of[face] == kNoLabel)
      regions.grow(faces, face, faces.normals[face], leastCosine);
  return regions;
}

// Adds charts for the faces that have none, from the regions in the order given.
void growFromRegions(const MeshFaces& faces, const Labels& regions, const std::vector<std::uint32_t>& order,
                     Labels& charts) {
  const double leastCosine = cosineOf(kChartAngleDeg);
  for (const std::uint32_t region : order)
    if (charts.of[regions.seeds[region]] == kNoLabel)
      charts.grow(faces, regions.seeds[region], regions.normals[region], leastCosine);
  for (std::uint32_t face = 0; face < faces.count(); ++face)
    if (faces.areas[face] > 0 && charts.of[face] == kNoLabel)
      charts.grow(faces, face, faces.normals[face], leastCosine);
}

// The normals and seeds for the next round: the mean normal by area, or that of the flat region which has at least half
// of the chart, so that a floor with a few stones is still seen straight from above. The seed is the face nearest to
// it.
Labels nextProxies(const MeshFaces& faces, const Labels& regions, const Labels& charts) {
  const std::size_t count = charts.normals.size();
  Labels next{std::vector<std::uint32_t>(faces.count(), kNoLabel), std::vector<glm::dvec3>(count, glm::dvec3(0)),
              std::vector<std::uint32_t>(count, kNoFace)};
  const std::vector<double> areas = areasOf(faces, charts), regionAreas = areasOf(faces, regions);
  std::vector<std::uint32_t> flattest(count, kNoLabel); // the largest region that reaches into the chart
  for (std::size_t face = 0; face < faces.count(); ++face) {
    const std::uint32_t chart = charts.of[face], region = regions.of[face];
    if (chart == kNoLabel) continue;
    next.normals[chart] += faces.areas[face] * faces.normals[face];
    if (flattest[chart] == kNoLabel || regionAreas[region] > regionAreas[flattest[chart]]) flattest[chart] = region;
  }
  std::vector<double> flatAreas(count, 0); // what the chart has of it
  for (std::size_t face = 0; face < faces.count(); ++face) {
    const std::uint32_t chart = charts.of[face];
    if (chart != kNoLabel && regions.of[face] == flattest[chart]) flatAreas[chart] += faces.areas[face];
  }
  for (std::size_t chart = 0; chart < count; ++chart)
    next.normals[chart] = flatAreas[chart] >= 0.5 * areas[chart] && flattest[chart] != kNoLabel
                              ? regions.normals[flattest[chart]]
                              : glm::normalize(next.normals[chart]);
  for (std::uint32_t face = 0; face < faces.count(); ++face) {
    const std::uint32_t chart = charts.of[face];
    if (chart == kNoLabel) continue;
    const auto nearness = [&](std::uint32_t f) { return glm::dot(faces.normals[f], next.normals[chart]); };
    if (next.seeds[chart] == kNoFace || nearness(face) > nearness(next.seeds[chart])) next.seeds[chart] = face;
  }
  return next;
}

// Grows all charts from their seeds at once, faces of the least distortion |n - normal|^2 first.
void partition(const MeshFaces& faces, Labels& charts) {
  struct Step {
    double distortion;
    std::uint32_t face, label;
    bool operator>(const Step& other) const {
      return std::tie(distortion, face, label) > std::tie(other.distortion, other.face, other.label);
    }
  };
  const double leastCosine = cosineOf(kChartAngleDeg);
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  const auto offer = [&](std::uint32_t face, std::uint32_t label) {
    const double cosine = glm::dot(faces.normals[face], charts.normals[label]);
    if (charts.of[face] == kNoLabel && cosine >= leastCosine) open.push({2 - 2 * cosine, face, label});
  };
  for (std::uint32_t label = 0; label < charts.seeds.size(); ++label)
    if (charts.seeds[label] != kNoFace) offer(charts.seeds[label], label);
  while (!open.empty()) {
    const Step step = open.top();
    open.pop();
    if (charts.of[step.face] != kNoLabel) continue;
    charts.of[step.face] = step.label;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t next = faces.neighbours[3 * std::size_t{step.face} + k];
      if (next != kNoFace) offer(next, step.label);
    }
  }
}

std::vector<Chart> toCharts(const MeshFaces& faces, const Labels& labels) {
  std::vector<Chart> charts(labels.normals.size());
  for (std::size_t chart = 0; chart < charts.size(); ++chart) charts[chart].normal = labels.normals[chart];
  for (std::uint32_t face = 0; face < faces.count(); ++face)
    if (labels.of[face] != kNoLabel) charts[labels.of[face]].faces.push_back(face);
  return charts;
}

// Charts of less than smallArea, the smallest first: each to the neighbour with the longest common border that it leans
// little enough from.
void mergeSmall(const MeshFaces& faces, double smallArea, Labels& labels) {
  std::vector<Chart> charts = toCharts(faces, labels);
  std::vector<double> areas = areasOf(faces, labels);
  std::vector<std::uint32_t> order = byArea(areas);
  std::reverse(order.begin(), order.end());
  const double leastCosine = cosineOf(kMergeAngleDeg);
  for (const std::uint32_t label : order) {
    Chart& chart = charts[label];
    if (areas[label] >= smallArea || chart.faces.empty()) continue;
    std::map<std::uint32_t, int> borders;
    for (const std::uint32_t face : chart.faces)
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t next = faces.neighbours[3 * std::size_t{face} + k];
        if (next != kNoFace && labels.of[next] != label) ++borders[labels.of[next]];
      }
    std::uint32_t best = kNoLabel;
    int mostEdges = 0;
    for (const auto& [other, edges] : borders) {
      const glm::dvec3 normal = charts[other].normal;
      const bool fits = std::all_of(chart.faces.begin(), chart.faces.end(), [&](std::uint32_t face) {
        return glm::dot(faces.normals[face], normal) >= leastCosine;
      });
      if (!fits || edges <= mostEdges) continue;
      mostEdges = edges;
      best = other;
    }
    if (best == kNoLabel) continue;
    for (const std::uint32_t face : chart.faces) labels.of[face] = best;
    areas[best] += areas[label];
    charts[best].faces.insert(charts[best].faces.end(), chart.faces.begin(), chart.faces.end());
    chart.faces.clear();
  }
}

} // namespace

std::vector<Chart> makeCharts(const MeshFaces& faces, double tinyArea) {
  const Labels regions = flatRegions(faces);
  const std::vector<std::uint32_t> order = byArea(areasOf(faces, regions));
  Labels charts{std::vector<std::uint32_t>(faces.count(), kNoLabel), {}, {}};
  growFromRegions(faces, regions, order, charts);
  for (int round = 0; round < kRounds; ++round) {
    mergeSmall(faces, std::numeric_limits<double>::max(), charts);
    charts = nextProxies(faces, regions, charts);
    partition(faces, charts);
    growFromRegions(faces, regions, order, charts);
  }
  mergeSmall(faces, tinyArea, charts);
  std::vector<Chart> result = toCharts(faces, charts);
  result.erase(std::remove_if(result.begin(), result.end(), [](const Chart& chart) { return chart.faces.empty(); }),
               result.end());
  return result;
}

std::vector<std::vector<std::uint32_t>> connectedParts(const MeshFaces& faces,
                                                       const std::vector<std::uint32_t>& subset) {
  std::unordered_map<std::uint32_t, bool> isOpen;
  for (const std::uint32_t face : subset) isOpen[face] = true;
  std::vector<std::vector<std::uint32_t>> parts;
  for (const std::uint32_t seed : subset) {
    if (!isOpen[seed]) continue;
    isOpen[seed] = false;
    std::vector<std::uint32_t>& part = parts.emplace_back(1, seed);
    for (std::size_t i = 0; i < part.size(); ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto next = isOpen.find(faces.neighbours[3 * std::size_t{part[i]} + k]);
        if (next == isOpen.end() || !next->second) continue;
        next->second = false;
        part.push_back(next->first);
      }
  }
  return parts;
}

} // namespace parity::bake
