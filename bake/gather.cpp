#include "bake/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "reference/sampling.h"

namespace parity::bake {

namespace {

// Share of the cosine in the density of directions.
constexpr double kCosineShare = 0.75;

double densityOf(double cosine) {
  return kCosineShare * cosine * std::numbers::inv_pi + (1 - kCosineShare) * 0.5 * std::numbers::inv_pi;
}

// About +Z, with that density: the distribution of the cosine c is kCosineShare c^2 + (1 - kCosineShare) c.
glm::dvec3 directionAt(const glm::dvec2& u) {
  constexpr double a = kCosineShare, b = 1 - kCosineShare;
  const double c = std::min((std::sqrt(b * b + 4 * a * u.x) - b) / (2 * a), 1.0);
  const double s = std::sqrt(std::max(1 - c * c, 0.0)), phi = 2 * std::numbers::pi * u.y;
  return {s * std::cos(phi), s * std::sin(phi), c};
}

// From a frame about `normal` (Duff et al. 2017) to the world.
glm::dvec3 toWorld(const glm::dvec3& n, const glm::dvec3& v) {
  const double s = std::copysign(1.0, n.z), a = -1 / (s + n.z), b = n.x * n.y * a;
  return v.x * glm::dvec3(1 + s * n.x * n.x * a, s * b, -s * n.x) + v.y * glm::dvec3(b, s + n.y * n.y * a, -n.y) +
         v.z * n;
}

class Sampled {
public:
  Sampled(const Surroundings& around, const SurfacePoint& point, bool bothSides, std::uint64_t& rays)
      : m_around(around), m_point(point), m_normal(point.normal), m_bothSides(bothSides), m_rays(rays) {}

  // Density of taking this direction by the cosine-like way.
  double density(const glm::dvec3& direction) const {
    const double cosine = glm::dot(m_normal, direction);
    if (m_bothSides) return densityOf(std::abs(cosine)) / 2;
    return cosine > 0 ? densityOf(cosine) : 0;
  }

  void addDirection(glm::dvec2 u) {
    bool behind = false;
    if (m_bothSides) {
      behind = u.x >= 0.5;
      u.x = behind ? 2 * u.x - 1 : 2 * u.x;
    }
    const glm::dvec3 direction = toWorld(behind ? -m_normal : m_normal, directionAt(u));
    glm::dvec3 origin;
    if (!leaves(direction, origin)) return;
    const double p = density(direction);
    ++m_rays;
    const auto hit = m_around.visibility.firstHit(origin, direction);
    glm::dvec3 radiance(0);
    if (!hit) {
      if (!m_around.sky) return;
      const reference::EnvironmentSample sky = m_around.sky->evaluate(direction);
      radiance = sky.radiance * (m_around.samplesSky ? p / (p + sky.pdf) : 1);
    } else {
      radiance = radianceOf(*hit, direction, p);
    }
    add(radiance / p, direction);
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
    const double p = density(direction);
    glm::dvec3 origin;
    if (cosine <= 0 || p <= 0 || !leaves(direction, origin) || m_around.surfaces.isHole(sample.hit)) return;
    // As far as the emitter's own triangle, less what rounding may be wrong by.
    const double margin = 2 * m_around.visibility.surfaceOffset(sample.position) / std::max(cosine, 1e-3);
    ++m_rays;
    if (m_around.visibility.isOccluded(origin, direction, distance - margin)) return;
    const double q = sample.pdf * d2 / cosine; // per steradian
    add(m_around.surfaces.emission(sample.hit) / (p + q), direction);
  }

  void addSky(const glm::dvec2& u) {
    const reference::EnvironmentSample sky = m_around.sky->sample(u);
    const double p = density(sky.direction);
    glm::dvec3 origin;
    if (p <= 0 || !leaves(sky.direction, origin)) return;
    ++m_rays;
    if (m_around.visibility.isOccluded(origin, sky.direction)) return;
    add(sky.radiance / (p + sky.pdf), sky.direction);
  }

  LightSum sum;

private:
  // Whether a ray may leave the surface that way; and from where.
  bool leaves(const glm::dvec3& direction, glm::dvec3& origin) const {
    const glm::dvec3 geometric(m_point.geometric);
    const double side = glm::dot(geometric, direction);
    if (side == 0 || (side < 0 && !m_bothSides)) return false;
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
      radiance += m_around.surfaces.emission(hit) * (p / (p + pdf * distance * distance / std::max(cosine, 1e-12)));
    } else {
      radiance += m_around.surfaces.emission(hit);
    }
    return radiance;
  }

  double cosineAt(const lighting::Visibility::Hit& hit, const glm::dvec3& direction) const {
    return std::abs(glm::dot(glm::dvec3(hit.geometric), direction));
  }

  void add(const glm::dvec3& flux, const glm::dvec3& direction) {
    const double cosine = glm::dot(m_normal, direction);
    sum.add(flux, direction, m_bothSides ? cosine : std::max(cosine, 0.0));
  }

  const Surroundings& m_around;
  const SurfacePoint& m_point;
  glm::dvec3 m_normal;
  bool m_bothSides;
  std::uint64_t& m_rays;
};

} // namespace

LightSum gatherSample(const Surroundings& around, const GatherPoints& texel, std::uint32_t index, std::uint32_t seed,
                      std::uint64_t& rays) {
  // The same numbers for every way of sampling: what their sum depends on has three dimensions, not more.
  const glm::dvec3 u = reference::sobolPoint3(index, seed);
  const auto count = static_cast<double>(texel.points.size());
  const auto chosen = static_cast<std::size_t>(std::min(u.z * count, count - 1));
  Sampled sampled(around, texel.points[chosen], texel.bothSides, rays);
  sampled.addDirection(u);
  if (!around.emitters.empty()) sampled.addEmitter(u);
  if (around.samplesSky) sampled.addSky(u);
  return sampled.sum;
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
