#include "reference/interreflection.h"

#include <array>
#include <cmath>
#include <numbers>

#include "reference/reflection.h"
#include "reference/replicates.h"

namespace parity::reference {

namespace {

class InterreflectionIntegrator {
public:
  InterreflectionIntegrator(const SurfaceSample& sample, const Lobes& lobes, const Surroundings& around,
                            const PointVisibility& fromHere, int bounces, std::uint32_t seed)
      : m_lobes(lobes), m_around(around), m_bounces(bounces), m_fromHere(fromHere),
        m_reflection(sample, lobes, m_fromHere), m_seed(hashCombine(hashCombine(sample.pixel, seed), 1)) {
    const bool glossy = lobes.hasSpecular() && !lobes.isMirror();
    constexpr double kWideAlpha = 0.1; // wide lobes profit from the cosine
    m_uses[kByCosine] = lobes.hasDiffuse() || (glossy && lobes.alpha() > kWideAlpha);
    m_uses[kByVisibleNormal] = glossy;
    m_uses[kByEmitter] = (lobes.hasDiffuse() || glossy) && !around.emitters.empty();
    m_uses[kByMirror] = lobes.hasSpecular() && lobes.isMirror();
  }

  // Points [begin, end) of one replicate, all ways.
  void add(Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) const {
    for (int way = 0; way < kWays; ++way) {
      if (!m_uses[way]) continue;
      const std::uint32_t seed = hashCombine(m_seed, static_cast<std::uint32_t>(replicate * kWays + way));
      for (std::uint32_t i = begin; i < end; ++i) {
        const glm::dvec2 u = sobolPoint(i, seed);
        PathPoints points(i, seed);
        if (way == kByEmitter)
          addEmitter(sum, u);
        else if (way == kByMirror)
          addMirrored(sum, points);
        else
          addDirection(sum, way, u, points);
      }
    }
  }

private:
  enum Way { kByCosine, kByVisibleNormal, kByEmitter, kByMirror, kWays };

  double density(const LobeValues& values, const glm::dvec3& local) const {
    return (m_uses[kByCosine] ? pdfCosine(local.z) : 0) + (m_uses[kByVisibleNormal] ? values.pdfSpecular : 0);
  }

  void addDirection(Sum& sum, int way, const glm::dvec2& u, PathPoints& points) const {
    glm::dvec3 local;
    if (way == kByCosine) {
      local = sampleCosine(u);
    } else {
      const auto light = m_lobes.sampleSpecular(m_reflection.view(), u);
      if (!light) return;
      local = m_reflection.foldUp(*light);
    }
    const glm::dvec3 direction = m_reflection.frame().toWorld(local);
    const auto hit = m_fromHere.firstHit(direction);
    if (!hit || !isSeen(m_around, *hit)) return;
    const LobeValues values = m_reflection.evaluate(local);
    const double pdf = density(values, local);
    if (!(pdf > 0)) return;
    const double pdfEmitter = m_uses[kByEmitter] ? emitterPdf(m_around, *hit, direction) : 0;
    const glm::dvec3 light = reflectedRadiance(m_around, *hit, direction, m_bounces - 1, points) / pdf +
                             m_around.surfaces.emission(*hit) / (pdf + pdfEmitter);
    sum.diffuse += values.diffuse * light;
    sum.specular += values.specular * light;
  }

  void addEmitter(Sum& sum, const glm::dvec2& u) const {
    const auto light = sampleEmitter(m_around, m_fromHere, u);
    if (!light) return;
    const glm::dvec3 local = m_reflection.frame().toLocal(light->direction);
    const LobeValues values = m_reflection.evaluate(local);
    const glm::dvec3 weighted = light->radiance / (light->pdf + density(values, local));
    sum.diffuse += values.diffuse * weighted;
    sum.specular += values.specular * weighted;
  }

  void addMirrored(Sum& sum, PathPoints& points) const {
    const glm::dvec3 direction = m_reflection.mirrorDirection();
    const auto hit = m_fromHere.firstHit(direction);
    if (!hit || !isSeen(m_around, *hit)) return;
    sum.specular +=
        m_reflection.mirrorReflectance() *
        (reflectedRadiance(m_around, *hit, direction, m_bounces - 1, points) + m_around.surfaces.emission(*hit));
  }

  const Lobes& m_lobes;
  const Surroundings& m_around;
  int m_bounces;
  PointVisibility m_fromHere;
  Reflection m_reflection;
  std::uint32_t m_seed;
  std::array<bool, kWays> m_uses{};
};

} // namespace

Integral integrateInterreflection(const SurfaceSample& sample, const Lobes& lobes, const Surroundings& around,
                                  const PointVisibility& fromHere, int bounces, const glm::dvec3& otherLight,
                                  const glm::dvec3& otherError, const IntegralOptions& options,
                                  const glm::dvec3& weight) {
  if (!lobes.hasDiffuse() && !lobes.hasSpecular()) return {};
  const InterreflectionIntegrator integrator(sample, lobes, around, fromHere, bounces, options.seed);
  return sumReplicates(
      options,
      [&](Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) {
        integrator.add(sum, replicate, begin, end);
      },
      [&](const Integral& now) {
        const double wanted = options.relativeError * largest(weight * (now.diffuse + now.specular) + otherLight);
        const glm::dvec3 error2 = now.standardError * now.standardError;
        return largest(weight * glm::sqrt(error2 + otherError * otherError)) <= wanted ||
               largest(weight * now.standardError) <= wanted / std::numbers::sqrt2;
      });
}

} // namespace parity::reference
