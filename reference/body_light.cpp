#include "reference/body_light.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "reference/interpolation.h"
#include "reference/reflection.h"
#include "reference/refracted_lobe.h"
#include "reference/replicates.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

using lighting::Visibility;

// Of a direction that a surface sends to its wrong side, mirrored at it.
glm::dvec3 toSide(const glm::dvec3& direction, const glm::dvec3& normal) {
  const double height = glm::dot(direction, normal);
  return height > 0 ? direction : direction - 2 * height * normal;
}

class BodyIntegrator {
public:
  BodyIntegrator(const SurfaceSample& sample, const Lobes& lobes, const BodySurroundings& around, std::uint32_t seed)
      : m_sample(sample), m_lobes(lobes), m_around(around),
        m_alpha(static_cast<double>(sample.roughness) * static_cast<double>(sample.roughness)),
        m_absorption(sample.absorption), m_geometric(glm::normalize(glm::dvec3(sample.geometricNormal))),
        m_frame(glm::normalize(glm::dvec3(sample.normal))),
        m_view(visibleView(m_frame.toLocal(glm::normalize(glm::dvec3(sample.view))))),
        m_hasSky(around.environment && !around.environment->isBlack()),
        m_samplesSky(m_hasSky && !around.environment->isEven()),
        m_seed(hashCombine(hashCombine(sample.pixel, seed), 2)) {
    const auto iors = shading::f64::dispersedIors(sample.ior, sample.dispersion);
    m_iors = {iors.x, iors.y, iors.z};
    m_entering = meanEntering();
  }

  // Points [begin, end) of one replicate.
  void add(Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) const {
    const std::uint32_t seed = hashCombine(m_seed, static_cast<std::uint32_t>(replicate));
    for (std::uint32_t i = begin; i < end; ++i) {
      const glm::dvec2 u = sobolPoint(i, seed);
      const PathPoints points(i, seed);
      if (m_iors.x == m_iors.z) {
        sum.specular += lightThrough(m_iors.y, u, points);
        continue;
      }
      for (int c = 0; c < 3; ++c) sum.specular[c] += lightThrough(m_iors[c], u, points)[c];
    }
  }

private:
  static constexpr int kMostTurns = 32;

  // One path, of an index. The same points give the same choices.
  glm::dvec3 lightThrough(double ior, const glm::dvec2& u, PathPoints points) const {
    const RefractedLobe entry(m_alpha, ior), exit(m_alpha, 1 / ior);
    const glm::dvec3 half = entry.sampleHalf(m_view, u);
    const auto refracted = entry.refract(m_view, half);
    if (!refracted) return glm::dvec3(0); // never: an index of at least 1 reflects nothing totally
    const glm::dvec3 direction = toSide(m_frame.toWorld(*refracted), -m_geometric);
    return enteringAt(glm::dot(m_view, half)) / m_entering * lightWithin(exit, direction, points);
  }

  // Of the light that comes along a ray within the body, from the sample on.
  glm::dvec3 lightWithin(const RefractedLobe& exit, glm::dvec3 direction, PathPoints& points) const {
    constexpr double kLeastLeft = 1e-6, kSurelyGoesOn = 0.2;
    glm::dvec3 light(0), throughput(1);
    glm::dvec3 from(m_sample.position), origin = m_around.bodies.leaveSurface(from, -m_geometric);
    for (int turn = 0; turn < kMostTurns && largest(throughput) > kLeastLeft; ++turn) {
      const auto hit = m_around.bodies.firstHitOf(m_sample.instance, origin, direction);
      if (!hit) return light + throughput * straightOn(origin, direction, points);
      if (const auto within = opaqueWithin(origin, direction, hit->distance))
        return light + throughput * kept(from, origin + static_cast<double>(within->distance) * direction) *
                           radianceOf(*within, direction, points);
      const Exit at(m_around, *hit, direction);
      throughput *= kept(from, at.position);
      const glm::dvec3 u = points.next(), half = exit.sampleHalf(at.view, glm::dvec2(u));
      const double F = exit.fresnel(std::clamp(glm::dot(at.view, half), 0.0, 1.0));
      light += throughput * lightOutside(exit, at, half, 1 - F, points);
      throughput *= F;
      if (!exit.isMirror()) {
        const double goesOn = std::min(largest(throughput) / kSurelyGoesOn, 1.0);
        if (!(u.z < goesOn)) return light;
        throughput /= goesOn;
      }
      direction = toSide(at.frame.toWorld(RefractedLobe::reflect(at.view, half)), at.geometric);
      from = at.position;
      origin = m_around.bodies.leaveSurface(from, at.geometric);
    }
    return light + throughput * straightOn(origin, direction, points);
  }

  // A point where a ray within meets the body's surface.
  struct Exit {
    Exit(const BodySurroundings& around, const Visibility::Hit& hit, const glm::dvec3& direction)
        : Exit(around, lighting::surfacePointAt(around.bodies.scene(), hit, -direction), direction) {}
    // point: looked at from outside.
    Exit(const BodySurroundings& around, const lighting::SurfacePoint& point, const glm::dvec3& direction)
        : position(point.position), geometric(-point.geometric),
          frame(glm::dot(point.smooth, point.geometric) > 0 ? -point.smooth : -point.geometric),
          view(visibleView(frame.toLocal(-direction))) {
      if (around.behind) fromHere = PointVisibility(around.behind->visibility, point);
    }
    glm::dvec3 position, geometric; // the normal points inwards
    Frame frame;                    // of the vertices' normal, inwards
    glm::dvec3 view;                // local
    PointVisibility fromHere;       // outwards
  };

  // What leaves at a microfacet. share: that which it refracts.
  glm::dvec3 lightOutside(const RefractedLobe& exit, const Exit& at, const glm::dvec3& half, double share,
                          PathPoints& points) const {
    glm::dvec3 light(0);
    const bool isJoined = m_samplesSky && exit.hasDensity();
    if (isJoined) light += sampledSky(exit, at, glm::dvec2(points.next()));
    const auto refracted = exit.refract(at.view, half);
    if (!refracted) return light;
    const glm::dvec3 direction = at.frame.toWorld(*refracted);
    const RefractedValues values = exit.hasDensity() ? exit.evaluate(at.view, *refracted) : RefractedValues{share, 1};
    if (!(values.pdf > 0)) return light; // along the surface
    if (const auto hit = at.fromHere.firstHit(direction))
      return light + values.value / values.pdf * radianceOf(*hit, direction, points);
    if (!m_hasSky) return light;
    const EnvironmentSample sky = m_around.environment->evaluate(direction);
    return light + values.value / (values.pdf + (isJoined ? sky.pdf : 0)) * sky.radiance;
  }

  glm::dvec3 sampledSky(const RefractedLobe& exit, const Exit& at, const glm::dvec2& u) const {
    const EnvironmentSample sky = m_around.environment->sample(u);
    const RefractedValues values = exit.evaluate(at.view, at.frame.toLocal(sky.direction));
    if (!(values.value > 0) || !at.fromHere.reaches(sky.direction)) return glm::dvec3(0);
    return values.value / (values.pdf + sky.pdf) * sky.radiance;
  }

  // As if the body ended here.
  glm::dvec3 straightOn(const glm::dvec3& origin, const glm::dvec3& direction, PathPoints& points) const {
    if (m_around.behind)
      if (const auto hit = besideBody(origin, direction)) return radianceOf(*hit, direction, points);
    return m_hasSky ? m_around.environment->evaluate(direction).radiance : glm::dvec3(0);
  }
  // What an opaque surface sends back along a ray.
  glm::dvec3 radianceOf(const Visibility::Hit& hit, const glm::dvec3& direction, PathPoints& points) const {
    const Surroundings& behind = *m_around.behind;
    if (!isSeen(behind, hit)) return glm::dvec3(0);
    return reflectedRadiance(behind, hit, direction, m_around.bounces - 1, points) + behind.surfaces.emission(hit);
  }

  std::optional<Visibility::Hit> besideBody(const glm::dvec3& origin, const glm::dvec3& direction,
                                            double distance = std::numeric_limits<double>::infinity()) const {
    return m_around.behind->visibility.firstHitBeside(m_sample.instance, origin, direction, distance);
  }
  // Nearer than the body's own surface, which lies on what touches it.
  std::optional<Visibility::Hit> opaqueWithin(const glm::dvec3& origin, const glm::dvec3& direction,
                                              double distance) const {
    if (!m_around.behind) return std::nullopt;
    return besideBody(origin, direction, distance - 2 * m_around.bodies.surfaceOffset(origin));
  }

  // From surface to surface: rays begin a little inside.
  glm::dvec3 kept(const glm::dvec3& from, const glm::dvec3& to) const {
    return glm::exp(-m_absorption * glm::distance(from, to));
  }

  // What the base lets through at a microfacet, and the mean of that over visible normals: Gauss' rule over the cap's
  // height, even points around it, which is within 1e-4. Where nothing is let through, the layer has no weight.
  glm::dvec3 enteringAt(double VoH) const { return 1.0 - m_lobes.fresnel(std::clamp(VoH, 0.0, 1.0)); }
  glm::dvec3 meanEntering() const {
    static const QuadratureRule heights = makeGaussRule(24);
    constexpr int kAround = 24;
    glm::dvec3 sum(0);
    const RefractedLobe entry(m_alpha, m_iors.y);
    for (std::size_t k = 0; k < heights.x.size(); ++k)
      for (int i = 0; i < kAround; ++i) {
        const glm::dvec3 half = entry.sampleHalf(m_view, {(i + 0.5) / kAround, heights.x[k]});
        sum += heights.weight[k] / kAround * enteringAt(glm::dot(m_view, half));
      }
    constexpr double kLeast = 1e-9;
    return glm::max(sum, kLeast);
  }

  const SurfaceSample& m_sample;
  const Lobes& m_lobes;
  const BodySurroundings& m_around;
  double m_alpha;
  glm::dvec3 m_absorption, m_geometric;
  Frame m_frame;
  glm::dvec3 m_view; // local
  bool m_hasSky, m_samplesSky;
  std::uint32_t m_seed;
  glm::dvec3 m_iors{1.0}, m_entering{1.0};
};

} // namespace

Integral integrateBody(const SurfaceSample& sample, const Lobes& lobes, const BodySurroundings& around,
                       const glm::dvec3& otherLight, const IntegralOptions& options, const glm::dvec3& weight) {
  const BodyIntegrator integrator(sample, lobes, around, options.seed);
  return sumReplicates(
      options,
      [&](Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) {
        integrator.add(sum, replicate, begin, end);
      },
      [&](const Integral& now) {
        return largest(weight * now.standardError) <=
               options.relativeError * largest(weight * now.specular + otherLight);
      });
}

} // namespace parity::reference
