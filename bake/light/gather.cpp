#include "bake/light/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/sampling.h"

namespace parity::bake {

namespace {

class Sampled {
public:
  Sampled(const Surroundings& around, const SurfacePoint& point, bool bothSides, const GatherWay& way,
          std::uint64_t& rays)
      : m_around(around), m_point(point), m_normal(point.normal), m_bothSides(bothSides), m_directions(way.directions),
        m_emitterShare(1.0 / (1 << way.shares.emitterSkips)), m_skyShare(1.0 / (1 << way.shares.skySkips)),
        m_rays(rays) {}

  // guided: the density of u.
  void addDirection(const glm::dvec2& u, double guided) {
    const glm::dvec3 direction = m_directions.at(u);
    glm::dvec3 origin;
    if (!leaves(direction, origin)) return;
    const double p = m_directions.pdf(direction);
    ++m_rays;
    const auto hit = m_around.visibility.firstHit(origin, direction);
    glm::dvec3 radiance(0);
    if (!hit) {
      if (!m_around.sky) return;
      const reference::EnvironmentSample sky = m_around.sky->evaluate(direction);
      radiance = sky.radiance * (m_around.samplesSky ? p / (p + m_skyShare * sky.pdf) : 1);
    } else {
      radiance = radianceOf(*hit, direction, p);
    }
    add(radiance / (p * guided), direction);
  }

  void addEmitter(const glm::dvec2& u) {
    const lighting::EmitterSample sample = m_around.emitters.sample(u);
    const glm::dvec3 way = sample.position - glm::dvec3(m_point.position);
    const double d2 = glm::dot(way, way);
    if (!(d2 > 0)) return;
    const double distance = std::sqrt(d2);
    const glm::dvec3 direction = way / distance;
    double cosine = -glm::dot(sample.normal, direction);
    if (sample.bothSides) cosine = std::abs(cosine);
    const double p = m_directions.pdf(direction);
    glm::dvec3 origin;
    if (cosine <= 0 || !leaves(direction, origin) || m_around.surfaces.isHole(sample.hit)) return;
    // As far as the emitter's own triangle, less what rounding may be wrong by.
    const double margin = 2 * m_around.visibility.surfaceOffset(sample.position) / std::max(cosine, 1e-3);
    ++m_rays;
    if (m_around.visibility.isOccluded(origin, direction, distance - margin)) return;
    const double q = m_emitterShare * sample.pdf * d2 / cosine; // per steradian
    add(m_around.surfaces.emission(sample.hit) / (p + q), direction);
  }

  void addSky(const glm::dvec2& u) {
    const reference::EnvironmentSample sky = m_around.sky->sample(u);
    glm::dvec3 origin;
    if (!leaves(sky.direction, origin)) return;
    ++m_rays;
    if (m_around.visibility.isOccluded(origin, sky.direction)) return;
    add(sky.radiance / (m_directions.pdf(sky.direction) + m_skyShare * sky.pdf), sky.direction);
  }

  LightSum sum;

private:
  // Whether a ray may leave the surface that way; and from where.
  bool leaves(const glm::dvec3& direction, glm::dvec3& origin) const {
    const glm::dvec3 geometric(m_point.geometric);
    const double side = glm::dot(geometric, direction);
    if (side == 0 || (!m_bothSides && (side < 0 || glm::dot(m_normal, direction) <= 0))) return false;
    origin = m_around.visibility.leaveSurface(m_point.position, side < 0 ? -geometric : geometric);
    return true;
  }

  glm::dvec3 radianceOf(const lighting::Visibility::Hit& hit, const glm::dvec3& direction, double p) const {
    // The back of what has but one side: black, as light does not pass it either.
    if (!hit.front && !m_around.surfaces.isDoubleSided(hit.instance)) return glm::dvec3(0);
    glm::dvec3 radiance(0);
    if (const ReflectedLight* reflected = hit.front ? m_around.reflected : m_around.reflectedByBacks)
      radiance = m_around.surfaces.albedo(hit) * glm::dvec3(reflected->irradiance(hit)) * std::numbers::inv_pi;
    if (const double pdf = m_around.emitters.pdf(hit); pdf > 0) {
      const double distance = hit.distance, cosine = cosineAt(hit, direction);
      radiance += m_around.surfaces.emission(hit) *
                  (p / (p + m_emitterShare * pdf * distance * distance / std::max(cosine, 1e-12)));
    } else {
      radiance += m_around.surfaces.emission(hit);
    }
    return radiance;
  }

  double cosineAt(const lighting::Visibility::Hit& hit, const glm::dvec3& direction) const {
    return std::abs(glm::dot(glm::dvec3(hit.geometric), direction));
  }

  void add(const glm::dvec3& flux, const glm::dvec3& direction) {
    sum.add(flux, direction, glm::dot(m_normal, direction));
  }

  const Surroundings& m_around;
  const SurfacePoint& m_point;
  glm::dvec3 m_normal;
  bool m_bothSides;
  const Directions& m_directions;
  double m_emitterShare, m_skyShare; // samples by these ways for each of a direction
  std::uint64_t& m_rays;
};

double luminanceOf(const LightSum& sum) { return lightmapLuminance(sum.irradiance + sum.back); }

} // namespace

glm::dvec3 gatherPoint(std::uint32_t index, std::uint32_t seed) { return reference::sobolPoint3(index, seed); }

GatherSample gatherSample(const Surroundings& around, const GatherPoints& texel, const GatherWay& way,
                          std::uint32_t index, std::uint32_t seed, std::uint64_t& rays) {
  const glm::dvec3 u = gatherPoint(index, seed);
  const auto count = static_cast<double>(texel.points.size());
  const auto chosen = static_cast<std::size_t>(std::min(u.z * count, count - 1));
  Sampled sampled(around, texel.points[chosen], texel.bothSides, way, rays);
  glm::dvec2 direction = u;
  const double guided = way.guide.warp(direction);
  sampled.addDirection(direction, guided);
  GatherSample result;
  // Those that are due take the points of the sequence one by one, so that what all of them sum up is stratified, too.
  const auto addDue = [&](int skips, auto addPoint) -> std::optional<double> {
    if ((index & ((1u << skips) - 1)) != 0) return {};
    const double before = luminanceOf(sampled.sum);
    addPoint(skips == 0 ? u : gatherPoint(index >> skips, seed));
    return luminanceOf(sampled.sum) - before;
  };
  if (!around.emitters.empty())
    result.emitters = addDue(way.shares.emitterSkips, [&](const glm::dvec3& v) { sampled.addEmitter(v); });
  if (around.samplesSky) result.sky = addDue(way.shares.skySkips, [&](const glm::dvec3& v) { sampled.addSky(v); });
  result.sum = sampled.sum;
  return result;
}

bool isUneven(const reference::EnvironmentSampler& sky) {
  if (sky.isBlack()) return false;
  constexpr std::uint32_t kCount = 4096;
  double sum = 0, squares = 0;
  for (std::uint32_t i = 0; i < kCount; ++i) {
    const glm::dvec2 u = reference::sobolPoint(i, 1);
    const double z = 2 * u.x - 1, r = std::sqrt(1 - z * z), phi = 2 * std::numbers::pi * u.y;
    const double l = lightmapLuminance(sky.evaluate({r * std::cos(phi), z, r * std::sin(phi)}).radiance);
    sum += l;
    squares += l * l;
  }
  const double mean = sum / kCount;
  return squares / kCount > 2 * mean * mean;
}

} // namespace parity::bake
