#include "bake/atlas/texel_points.h"

#include <cmath>
#include <numbers>

#include "reference/sampling.h"

namespace parity::bake {

namespace {

// What may be wrong with a point: of its rays more end at backs, or at once, than those of one in a corner do.
constexpr double kMostBacks = 0.4, kMostNear = 0.8;
constexpr std::uint32_t kRays = 32; // of a point that is looked at closely

struct Tally {
  int backs = 0, nears = 0;
};

Tally castAround(const SurfacePoint& point, const lighting::Visibility& visibility,
                 const lighting::SurfaceLight& surfaces, double near, std::uint32_t first, std::uint32_t count,
                 std::uint32_t seed) {
  const glm::dvec3 n(point.geometric), origin = visibility.leaveSurface(point.position, n);
  const glm::dvec3 aside = std::abs(n.x) < 0.6 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 t = glm::normalize(glm::cross(aside, n)), b = glm::cross(n, t);
  Tally tally;
  for (std::uint32_t i = first; i < first + count; ++i) {
    const glm::dvec3 local = reference::sampleCosine(reference::sobolPoint(i, seed));
    const auto hit = visibility.firstHit(origin, local.x * t + local.y * b + local.z * n);
    if (!hit) continue;
    const bool isBack = !hit->front && !surfaces.isDoubleSided(hit->instance);
    tally.backs += isBack;
    tally.nears += isBack || hit->distance < near;
  }
  return tally;
}

} // namespace

TexelPoints pointsOf(const TexelGrid& grid, const Texel& texel, std::uint16_t mask) {
  TexelPoints result;
  for (int s = 0; s < kFactor * kFactor; ++s) {
    if ((mask & 1 << s) == 0) continue;
    const auto point = grid.at(texel.page, texel.x * kFactor + s % kFactor, texel.y * kFactor + s / kFactor);
    if (!point || point->instance != texel.instance) continue;
    result.points[result.count] = *point;
    result.subTexel[result.count++] = static_cast<std::uint8_t>(s);
  }
  return result;
}

std::uint16_t findValid(const TexelPoints& points, const lighting::Visibility& visibility,
                        const lighting::SurfaceLight& surfaces, double near, std::uint32_t seed, std::uint64_t& rays) {
  std::uint16_t all = 0;
  // One ray of each point first, all different: most texels are wholly in the open.
  int suspects = 0;
  for (std::size_t k = 0; k < points.count; ++k) {
    all = static_cast<std::uint16_t>(all | 1 << points.subTexel[k]);
    const Tally tally =
        castAround(points.points[k], visibility, surfaces, near, static_cast<std::uint32_t>(k), 1, seed);
    suspects += tally.nears;
  }
  rays += points.count;
  if (suspects == 0) return all;
  std::uint16_t valid = 0;
  for (std::size_t k = 0; k < points.count; ++k) {
    const Tally tally = castAround(points.points[k], visibility, surfaces, near, 0, kRays,
                                   reference::hashCombine(seed, static_cast<std::uint32_t>(k)));
    if (tally.backs > kMostBacks * kRays || tally.nears > kMostNear * kRays) continue;
    valid = static_cast<std::uint16_t>(valid | 1 << points.subTexel[k]);
  }
  rays += points.count * kRays;
  return valid;
}

} // namespace parity::bake
