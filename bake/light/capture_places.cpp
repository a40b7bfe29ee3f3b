#include "bake/light/capture_places.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <optional>

#include <glm/gtc/constants.hpp>

#include "base/parallel.h"

namespace parity::bake {

namespace {

constexpr int kGridSide = 12;   // points along the longest side of the bounds
constexpr int kBundleSide = 5;  // rays of a bundle along its side
constexpr int kBisections = 20; // of a distance: to a millionth of where it began

scenes::Bounds boundsOf(const scenes::Scene& scene) {
  scenes::Bounds bounds = scene.bounds();
  // Flat scenes: above them there is room for a capture.
  const glm::vec3 size = bounds.upper - bounds.lower;
  const float least = std::max(0.25f * std::max({size.x, size.y, size.z}), 1e-3f);
  for (int c = 0; c < 3; ++c)
    if (size[c] < 0.1f * least) bounds.upper[c] += least;
  return bounds;
}

// The distance in [0, farthest] up to which isFree(distance), which no farther one is again.
template <typename IsFree> double bisect(double farthest, const IsFree& isFree) {
  if (isFree(farthest)) return farthest;
  double free = 0, met = farthest;
  for (int i = 0; i < kBisections; ++i) {
    const double middle = 0.5 * (free + met);
    (isFree(middle) ? free : met) = middle;
  }
  return 0.5 * (free + met);
}

// Towards the points of a grid on the surface of a cube: about 25 degrees from each other.
std::vector<glm::dvec3> makeDirections() {
  std::vector<glm::dvec3> directions;
  for (int x = -2; x <= 2; ++x)
    for (int y = -2; y <= 2; ++y)
      for (int z = -2; z <= 2; ++z)
        if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 2)
          directions.push_back(glm::normalize(glm::dvec3(x, y, z)));
  return directions;
}

// To what is met first and to the bounds.
double clearanceAt(const lighting::Visibility& visibility, const scenes::Bounds& bounds, const glm::dvec3& position,
                   const std::vector<glm::dvec3>& directions) {
  const glm::dvec3 inside = glm::min(position - glm::dvec3(bounds.lower), glm::dvec3(bounds.upper) - position);
  return bisect(std::min({inside.x, inside.y, inside.z}), [&](double distance) {
    return std::none_of(directions.begin(), directions.end(), [&](const glm::dvec3& direction) {
      return visibility.isOccluded(position, direction, distance);
    });
  });
}

// Whether closed surfaces, fronts outwards, go around a point: the generalized winding number (Jacobson, Kavan and
// Sorkine-Hornung 2013) is above a half. Rooms with fronts inwards do not count, nor does what has two sides.
bool isInside(const scenes::Scene& scene, const glm::dvec3& point) {
  double angle = 0; // solid angles of triangles by van Oosterom and Strackee 1983, eq. 8
  for (const scenes::Instance& instance : scene.instances) {
    const scenes::Mesh& mesh = scene.meshes[instance.mesh];
    const scenes::Material& material = scene.materials[mesh.material];
    if (material.doubleSided || material.unlit || material.alphaMode == scenes::AlphaMode::blend) continue;
    const glm::dmat4 toWorld(instance.toWorld);
    std::vector<glm::dvec3> corners;
    for (const glm::vec3& p : mesh.positions) corners.push_back(glm::dvec3(toWorld * glm::dvec4(p, 1)) - point);
    double sum = 0;
    for (std::size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
      const glm::dvec3 &a = corners[mesh.indices[i]], &b = corners[mesh.indices[i + 1]],
                       &c = corners[mesh.indices[i + 2]];
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      sum += 2 * std::atan2(glm::dot(a, glm::cross(b, c)),
                            la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb);
    }
    angle += glm::determinant(glm::dmat3(toWorld)) < 0 ? -sum : sum;
  }
  return angle > 0.5 * 4 * glm::pi<double>();
}

struct Candidate {
  glm::dvec3 position{0.0};
  double clearance = 0, score = 0;
  std::optional<bool> isInside; // found out only where it matters
};

std::vector<Candidate> makeCandidates(const scenes::Bounds& bounds, const lighting::Visibility& visibility) {
  const glm::dvec3 lower(bounds.lower), size = glm::dvec3(bounds.upper) - lower;
  const double longest = std::max({size.x, size.y, size.z});
  std::array<int, 3> counts;
  for (int c = 0; c < 3; ++c)
    counts[static_cast<std::size_t>(c)] =
        std::clamp(static_cast<int>(std::lround(kGridSide * size[c] / longest)), 3, kGridSide);
  std::vector<Candidate> candidates;
  for (int x = 0; x < counts[0]; ++x)
    for (int y = 0; y < counts[1]; ++y)
      for (int z = 0; z < counts[2]; ++z)
        candidates.push_back(
            {lower + size * (glm::dvec3(x, y, z) + 0.5) / glm::dvec3(counts[0], counts[1], counts[2]), 0, 0, {}});
  const std::vector<glm::dvec3> directions = makeDirections();
  base::parallelFor(candidates.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      Candidate& candidate = candidates[i];
      candidate.clearance = clearanceAt(visibility, bounds, candidate.position, directions);
      const double fromMiddle = glm::length(candidate.position - glm::dvec3(bounds.center())) / bounds.radius();
      candidate.score = candidate.clearance * (1 - 0.5 * fromMiddle);
    }
  });
  return candidates;
}

// The one with the highest value that lies within nothing; a value below 0 is out of the question.
template <typename Value>
Candidate* findBest(const scenes::Scene& scene, std::vector<Candidate>& candidates, const Value& valueOf) {
  for (;;) {
    Candidate* best = nullptr;
    double highest = 0;
    for (Candidate& candidate : candidates) {
      if (candidate.isInside.value_or(false)) continue;
      const double value = valueOf(candidate);
      if (value > highest) highest = value, best = &candidate;
    }
    if (!best || best->isInside) return best;
    best->isInside = isInside(scene, best->position);
    if (!*best->isInside) return best;
  }
}

} // namespace

CapturePlace placeCapture(const scenes::Scene& scene, const lighting::Visibility& visibility,
                          const glm::vec3& position) {
  const scenes::Bounds bounds = boundsOf(scene);
  const glm::dvec3 from(position);
  CapturePlace place{position, position, position, 0};
  const double half = 0.7 * clearanceAt(visibility, bounds, from, makeDirections()); // the bundle's corners are clear
  for (int axis = 0; axis < 3; ++axis)
    for (const bool isUpper : {false, true}) {
      const double farthest = isUpper ? bounds.upper[axis] - from[axis] : from[axis] - bounds.lower[axis];
      if (!(farthest > 0)) continue; // the position is on the rim of the bounds or outside
      glm::dvec3 direction(0.0);
      direction[axis] = isUpper ? 1 : -1;
      std::vector<double> distances;
      for (int i = 0; i < kBundleSide * kBundleSide; ++i) {
        glm::dvec3 origin = from;
        const int row = i / kBundleSide, column = i % kBundleSide;
        origin[(axis + 1) % 3] += half * (2.0 * column / (kBundleSide - 1) - 1);
        origin[(axis + 2) % 3] += half * (2.0 * row / (kBundleSide - 1) - 1);
        distances.push_back(
            bisect(farthest, [&](double distance) { return !visibility.isOccluded(origin, direction, distance); }));
      }
      std::nth_element(distances.begin(), distances.begin() + distances.size() / 2, distances.end());
      (isUpper ? place.boxUpper : place.boxLower)[axis] +=
          static_cast<float>(direction[axis] * distances[distances.size() / 2]);
    }
  const glm::vec3 reach = glm::max(glm::abs(bounds.lower - position), glm::abs(bounds.upper - position));
  place.radius = glm::length(reach);
  return place;
}

std::vector<CapturePlace> findCapturePlaces(const scenes::Scene& scene, const lighting::Visibility& visibility,
                                            int count) {
  assert(count >= 1);
  const scenes::Bounds bounds = boundsOf(scene);
  std::vector<Candidate> candidates = makeCandidates(bounds, visibility);
  std::vector<glm::dvec3> positions;
  double least = 0; // clearance of all but the first
  while (static_cast<int>(positions.size()) < count) {
    const Candidate* best = findBest(scene, candidates, [&](const Candidate& candidate) {
      if (positions.empty()) return candidate.score;
      if (candidate.clearance < least) return -1.0;
      double nearest = std::numeric_limits<double>::infinity();
      for (const glm::dvec3& position : positions)
        nearest = std::min(nearest, glm::length(candidate.position - position));
      return nearest;
    });
    if (!best) break;
    if (positions.empty()) least = 0.5 * best->clearance;
    positions.push_back(best->position);
  }
  if (positions.empty()) positions.push_back(bounds.center());
  std::vector<CapturePlace> places;
  for (const glm::dvec3& position : positions) places.push_back(placeCapture(scene, visibility, glm::vec3(position)));
  return places;
}

} // namespace parity::bake
