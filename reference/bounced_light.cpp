#include "reference/bounced_light.h"

#include <algorithm>
#include <cmath>

#include "lighting/surface/surface_material.h"
#include "reference/direct_light.h"
#include "reference/reflection.h"
#include "scenes/luminance.h"

namespace parity::reference {

namespace {

using lighting::Visibility;

using scenes::luminanceOf;

SurfaceSample sampleAt(const scenes::Scene& scene, const Visibility::Hit& hit, const lighting::SurfacePoint& point,
                       const glm::dvec3& direction) {
  const lighting::SurfaceMaterial material = lighting::surfaceMaterialAt(scene, hit, point);
  SurfaceSample sample;
  sample.position = point.position;
  sample.normal = material.normal;
  sample.geometricNormal = point.geometric;
  sample.view = -direction;
  sample.baseColor = material.baseColor;
  sample.metallic = static_cast<float>(material.metallic);
  sample.roughness = static_cast<float>(material.roughness);
  sample.dielectricF0 = material.F0;
  sample.dielectricF90 = static_cast<float>(material.F90);
  sample.occlusion = static_cast<float>(material.occlusion);
  return sample;
}

// A direction in which a path goes on.
struct Onward {
  glm::dvec3 direction{0.0}; // world
  glm::dvec3 weight{0.0};    // f cos / pdf
  double pdf = 0;            // per steradian; 0: of a mirror
};

// One vertex of a path.
class Vertex {
public:
  Vertex(const Surroundings& around, const Visibility::Hit& hit, const glm::dvec3& direction)
      : m_around(around), m_point(lighting::surfacePointAt(around.visibility.scene(), hit, direction)),
        m_sample(sampleAt(around.visibility.scene(), hit, m_point, direction)),
        m_fromHere(around.castsShadows ? PointVisibility(around.visibility, m_point) : PointVisibility()),
        m_lobes(m_sample, around.model, m_sample.roughness, around.albedo), m_reflection(m_sample, m_lobes, m_fromHere),
        m_glossy(m_lobes.hasSpecular() && !m_lobes.isMirror()) {
    const double specular = m_lobes.hasSpecular() ? luminanceOf(m_reflection.mirrorReflectance()) : 0;
    const double diffuse = m_lobes.hasDiffuse() ? luminanceOf(m_reflection.diffuseAlbedo()) : 0;
    constexpr double kLeast = 0.1, kWideAlpha = 0.1; // wide lobes profit from the cosine
    if (m_lobes.hasSpecular()) m_specularShare = diffuse + specular > 0 ? specular / (diffuse + specular) : 1;
    if (m_lobes.hasDiffuse() || (m_glossy && m_lobes.alpha() > kWideAlpha))
      m_specularShare = std::min(m_specularShare, 1 - kLeast);
    if (m_lobes.hasSpecular()) m_specularShare = std::max(m_specularShare, kLeast);
  }

  double occlusion() const { return m_sample.occlusion; }

  glm::dvec3 ofLights() const {
    const DirectLight light = shadeDirect(m_sample, m_around.lights, m_around.model, m_around.albedo, m_fromHere);
    return light.sunDiffuse + light.sunSpecular + light.localDiffuse + light.localSpecular;
  }

  glm::dvec3 ofEnvironment(const glm::dvec2& u) const {
    if (!samplesLight()) return glm::dvec3(0);
    const EnvironmentSample light = m_around.environment->sample(u);
    const glm::dvec3 local = m_reflection.frame().toLocal(light.direction);
    if (!m_reflection.mayReflect(local) || !m_fromHere.reaches(light.direction)) return glm::dvec3(0);
    return reflected(local, light.radiance, light.pdf);
  }

  glm::dvec3 ofEmitters(const glm::dvec2& u) const {
    if (!samplesLight()) return glm::dvec3(0);
    const auto light = sampleEmitter(m_around, m_fromHere, u);
    if (!light) return glm::dvec3(0);
    return reflected(m_reflection.frame().toLocal(light->direction), light->radiance, light->pdf);
  }

  // u.z chooses the lobe.
  std::optional<Onward> goOn(const glm::dvec3& u) const {
    const bool specular = u.z < m_specularShare;
    if (specular && m_lobes.isMirror())
      return Onward{m_reflection.mirrorDirection(), m_reflection.mirrorReflectance() / m_specularShare, 0};
    glm::dvec3 local;
    if (specular) {
      const auto light = m_lobes.sampleSpecular(m_reflection.view(), glm::dvec2(u));
      if (!light) return std::nullopt;
      local = m_reflection.foldUp(*light);
    } else {
      local = sampleCosine(glm::dvec2(u));
    }
    const LobeValues values = m_reflection.evaluate(local);
    const double pdf = density(values, local);
    if (!(pdf > 0)) return std::nullopt;
    return Onward{m_reflection.frame().toWorld(local), (values.diffuse + values.specular) / pdf, pdf};
  }

  std::optional<Visibility::Hit> firstHit(const glm::dvec3& direction) const { return m_fromHere.firstHit(direction); }
  bool isAboveHorizon(const glm::dvec3& direction) const { return m_fromHere.isAboveHorizon(direction); }

private:
  // Mirrors alone see no light that is sampled.
  bool samplesLight() const { return m_lobes.hasDiffuse() || m_glossy; }

  // Of goOn, but for mirrors.
  double density(const LobeValues& values, const glm::dvec3& local) const {
    return (m_glossy ? m_specularShare * values.pdfSpecular : 0) + (1 - m_specularShare) * pdfCosine(local.z);
  }

  glm::dvec3 reflected(const glm::dvec3& local, const glm::dvec3& radiance, double pdf) const {
    const LobeValues values = m_reflection.evaluate(local);
    return (values.diffuse + values.specular) * radiance / (pdf + density(values, local));
  }

  const Surroundings& m_around;
  lighting::SurfacePoint m_point;
  SurfaceSample m_sample;
  PointVisibility m_fromHere;
  Lobes m_lobes;
  Reflection m_reflection;
  bool m_glossy;
  double m_specularShare = 0;
};

} // namespace

double emitterPdf(const Surroundings& around, const Visibility::Hit& hit, const glm::dvec3& direction) {
  const double cosine = std::abs(glm::dot(glm::dvec3(hit.geometric), direction)), distance = hit.distance;
  return around.emitters.pdf(hit) * distance * distance / std::max(cosine, 1e-12);
}

std::optional<EmitterLight> sampleEmitter(const Surroundings& around, const PointVisibility& fromHere,
                                          const glm::dvec2& u) {
  const lighting::EmitterSample sample = around.emitters.sample(u);
  const glm::dvec3 way = sample.position - fromHere.origin();
  const double d2 = glm::dot(way, way), distance = std::sqrt(d2);
  if (!(d2 > 0)) return std::nullopt;
  const glm::dvec3 direction = way / distance;
  double cosine = -glm::dot(sample.normal, direction);
  if (sample.bothSides) cosine = std::abs(cosine);
  if (!(cosine > 0) || !fromHere.isAboveHorizon(direction) || around.surfaces.isHole(sample.hit)) return std::nullopt;
  // As far as the emitter's own triangle, less what rounding may be wrong by.
  const double margin = 2 * around.visibility.surfaceOffset(sample.position) / std::max(cosine, 1e-3);
  if (!fromHere.isOpen(direction, distance - margin)) return std::nullopt;
  return EmitterLight{direction, around.surfaces.emission(sample.hit), sample.pdf * d2 / cosine};
}

glm::dvec3 reflectedRadiance(const Surroundings& around, const Visibility::Hit& first, const glm::dvec3& direction,
                             int bounces, PathPoints& points) {
  const bool hasSky = around.environment && !around.environment->isBlack();
  glm::dvec3 radiance(0), throughput(1), along = direction;
  Visibility::Hit hit = first;
  for (int left = bounces;; --left) {
    if (!isSeen(around, hit)) return radiance;
    const Vertex vertex(around, hit, along);
    radiance += throughput * vertex.ofLights();
    throughput *= vertex.occlusion();
    const glm::dvec3 u = points.next();
    if (hasSky) radiance += throughput * vertex.ofEnvironment(glm::dvec2(u));
    if (left > 0 && !around.emitters.empty()) radiance += throughput * vertex.ofEmitters(glm::dvec2(points.next()));
    if (left == 0 && !hasSky) return radiance;
    const auto onward = vertex.goOn(points.next());
    if (!onward || !vertex.isAboveHorizon(onward->direction)) return radiance;
    throughput *= onward->weight;
    if (!(std::max({throughput.x, throughput.y, throughput.z}) > 0)) return radiance;
    const auto next = vertex.firstHit(onward->direction);
    if (!next) {
      if (!hasSky) return radiance;
      const EnvironmentSample sky = around.environment->evaluate(onward->direction);
      const double share = onward->pdf > 0 ? onward->pdf / (onward->pdf + sky.pdf) : 1;
      return radiance + throughput * sky.radiance * share;
    }
    if (left == 0 || !isSeen(around, *next)) return radiance;
    const double share =
        onward->pdf > 0 ? onward->pdf / (onward->pdf + emitterPdf(around, *next, onward->direction)) : 1;
    radiance += throughput * around.surfaces.emission(*next) * share;
    hit = *next;
    along = onward->direction;
  }
}

} // namespace parity::reference
