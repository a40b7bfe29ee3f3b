#include "reference/environment_integral.h"

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>

#include "reference/linear_control.h"
#include "reference/point_visibility.h"
#include "reference/product_sampler.h"
#include "reference/reflection.h"
#include "reference/replicates.h"
#include "reference/sampling.h"
#include "scenes/luminance.h"
#include "shading/shading.h"

namespace parity::reference {

namespace {

using scenes::luminanceOf;

// Directions are of the panorama's frame, or local, with the normal as +Z.
class EnvironmentIntegrator {
public:
  EnvironmentIntegrator(const SurfaceSample& sample, const Lobes& lobes, const EnvironmentSampler& environment,
                        std::uint32_t seed, const PointVisibility& fromHere)
      : m_lobes(lobes), m_environment(environment), m_fromHere(fromHere), m_isShadowed(fromHere.hasHorizon()),
        m_normal(glm::normalize(glm::dvec3(sample.normal))),
        m_frame(lobes.isStretched()
                    ? Frame(environment.toPanorama(m_normal), environment.toPanorama(glm::dvec3(sample.tangent)))
                    : Frame(environment.toPanorama(m_normal))),
        m_view(visibleView(m_frame.toLocal(environment.toPanorama(glm::normalize(glm::dvec3(sample.view)))))),
        m_viewInPanorama(m_frame.toWorld(m_view)), m_atView(lobes.viewAt(m_view)),
        m_isGlossy(lobes.hasSpecular() && !lobes.isMirror()), m_seed(hashCombine(sample.pixel, seed)) {
    // A smaller share is as well sampled with the rest.
    constexpr double kWorthIrradiance = 0.03;
    const glm::dvec3 multiple = lobes.multipleReflectance(m_atView);
    if (!m_isShadowed && (lobes.hasDiffuse() || luminanceOf(multiple) > kWorthIrradiance))
      m_spread = multiple * std::numbers::inv_pi;
    if (!m_isShadowed) return;
    m_reflection.emplace(sample, lobes, m_fromHere);
    m_folds = m_isGlossy && glm::dot(m_normal, m_fromHere.horizonNormal()) < 1 - 1e-6;
  }

  // What needs no sampling.
  Integral inClosedForm() const {
    Integral known;
    if (!m_isShadowed && (m_lobes.hasDiffuse() || luminanceOf(m_spread) > 0)) {
      const glm::dvec3 irradiance = m_environment.irradiance(m_normal);
      known.diffuse = m_lobes.diffuseReflectance(m_atView) * irradiance * std::numbers::inv_pi;
      known.specular = m_spread * irradiance;
    }
    if (m_lobes.hasSpecular() && m_lobes.isMirror()) known.specular += reflectedByMirror();
    return known;
  }
  bool needsSamples() const { return m_isGlossy || (m_isShadowed && m_lobes.hasDiffuse()); }

  // besides: what is in closed form, and other layers.
  void prepareSampling(const glm::dvec3& besides) {
    ProductLobe lobe{.normal = m_frame.z, .view = m_frame.toWorld(m_view), .alpha = m_lobes.alpha()};
    if (m_lobes.isStretched()) m_axes = m_lobes.stretchedAxes(m_frame.x, m_frame.y);
    lobe.stretched = m_axes;
    lobe.sheen = m_lobes.sheen();
    if (m_isGlossy && !lobe.sheen) {
      lobe.F0 = luminanceOf(m_lobes.F0()), lobe.F90 = m_lobes.F90();
      if (m_lobes.hasFilm()) {
        lobe.F0 = lobe.F90 = 1; // there is a lobe, whatever the base
        lobe.luminanceOfFilm = [&](double VoH) { return luminanceOf(m_lobes.fresnel(VoH)); };
      }
    }
    // Of what is in closed form about a fifth remains, either sign.
    constexpr double kRemainder = 0.2;
    const double multiple = luminanceOf(m_lobes.multipleReflectance(m_atView));
    lobe.lambert = luminanceOf(m_spread) > 0 ? kRemainder * multiple : multiple;
    if (m_isShadowed) lobe.lambert += luminanceOf(m_lobes.diffuseReflectance(m_atView));
    // Under an even sky blocks say nothing, and points without them are spread more smoothly.
    if (m_environment.isEven()) {
      m_uses[kByEnvironment] = true;
      m_uses[kByVisibleNormal] = m_isGlossy;
      return;
    }
    m_product.emplace(m_environment.light(), lobe, luminanceOf(besides) / m_environment.totalLuminance());
    m_uses[kByProduct] = !m_product->isBlack();
    // A wide lobe varies so little within the product's blocks that points by the lobe alone add noise to it. What is
    // folded up at the horizon the product does not know.
    constexpr double kWideAlpha = 0.06;
    m_uses[kByVisibleNormal] = m_isGlossy && (m_lobes.alpha() < kWideAlpha || !m_uses[kByProduct] || m_folds);
    if (m_isShadowed || !m_uses[kByProduct]) return;
    m_control.emplace(m_environment, *m_product, m_frame.z,
                      [&](const FourDirections& directions) { return estimateSampled(directions); });
    m_product->scale(m_control->remainders());
  }

  // What the control variate has of the light that is sampled.
  glm::dvec3 controlled() const { return m_control ? m_control->integral() : glm::dvec3(0.0); }

  // Points [begin, end) of one replicate, all ways.
  void add(Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) const {
    for (int way = 0; way < kWays; ++way) {
      if (!m_uses[way]) continue;
      const std::uint32_t seed = hashCombine(m_seed, static_cast<std::uint32_t>(replicate * kWays + way));
      for (std::uint32_t i = begin; i < end; ++i) addPoint(sum, way, sobolPoint(i, seed));
    }
  }

private:
  enum Way { kByProduct, kByEnvironment, kByVisibleNormal, kWays };

  glm::dvec3 reflectedByMirror() const {
    const glm::dvec3 mirrored = m_reflection ? m_reflection->mirrorDirection()
                                             : m_environment.toWorld(m_frame.toWorld({-m_view.x, -m_view.y, m_view.z}));
    if (!m_fromHere.reaches(mirrored)) return glm::dvec3(0.0);
    return m_lobes.fresnel(m_view.z) * m_environment.evaluate(mirrored).radiance;
  }

  // About the specular part that is sampled.
  std::array<Float4, 3> estimateSampled(const FourDirections& directions) const {
    const glm::vec3 normal(m_frame.z), spread(m_spread);
    std::array<Float4, 3> values = m_lobes.estimateSpecular(directions, normal, m_viewInPanorama, m_atView, m_axes);
    const Float4 NoL = normal.x * directions.x + normal.y * directions.y + normal.z * directions.z;
    for (int c = 0; c < 3; ++c) values[static_cast<std::size_t>(c)] -= spread[c] * NoL;
    return values;
  }

  // A direction of the lobe (panorama's frame), folded up at the horizon.
  glm::dvec3 byVisibleNormal(const glm::dvec3& local) const {
    const glm::dvec3 direction = m_frame.toWorld(local);
    if (!m_isShadowed) return direction;
    const glm::dvec3 world = m_environment.toWorld(direction);
    return m_fromHere.isAboveHorizon(world) ? direction : m_environment.toPanorama(m_fromHere.mirror(world));
  }

  // Nothing where no light of this direction is reflected, or none arrives.
  std::optional<LobeValues> valuesAt(const glm::dvec3& direction, const glm::dvec3& local) const {
    if (!m_reflection) return local.z > 0 ? std::optional(m_lobes.evaluate(m_view, local, m_atView)) : std::nullopt;
    const glm::dvec3 world = m_environment.toWorld(direction), inWorldsFrame = m_reflection->frame().toLocal(world);
    if (!m_reflection->mayReflect(inWorldsFrame) || !m_fromHere.reaches(world)) return std::nullopt;
    return m_reflection->evaluate(inWorldsFrame);
  }

  void addPoint(Sum& sum, int way, const glm::dvec2& u) const {
    glm::dvec3 direction, local;
    glm::ivec2 at;
    std::uint32_t node = 0;
    if (way == kByProduct) {
      const ProductSampler::Sample s = m_product->sample(u);
      direction = s.direction;
      at = {s.x, s.y};
      node = s.node;
      local = m_frame.toLocal(direction);
    } else {
      if (way == kByEnvironment) {
        direction = m_environment.toPanorama(m_environment.sample(u).direction);
        local = m_frame.toLocal(direction);
      } else {
        const auto light = m_lobes.sampleSpecular(m_view, u);
        if (!light) return;
        local = *light;
        direction = byVisibleNormal(local);
      }
      const glm::dvec2 place = m_environment.placeOf(direction);
      at = glm::ivec2(place);
      if (m_uses[kByProduct]) node = m_product->nodeOf(place);
    }
    const std::optional<LobeValues> values = valuesAt(direction, local);
    if (!values) return;
    const glm::dvec4 light(m_environment.cell(at.x, at.y));
    const double pdf = (m_uses[kByProduct] ? light.w * m_product->gain(node) : 0) +
                       (m_uses[kByEnvironment] ? light.w : 0) + (m_uses[kByVisibleNormal] ? values->pdfSpecular : 0);
    if (!(pdf > 0)) return; // a rounding off the support of all
    const glm::dvec3 weight = glm::dvec3(light) / pdf;
    if (m_isShadowed) sum.diffuse += values->diffuse * weight;
    glm::dvec3 specular = values->specular - m_spread * local.z;
    if (m_control) specular -= m_control->at(node, direction);
    sum.specular += specular * weight;
  }

  const Lobes& m_lobes;
  const EnvironmentSampler& m_environment;
  PointVisibility m_fromHere;
  bool m_isShadowed;
  glm::dvec3 m_normal; // world
  Frame m_frame;
  glm::dvec3 m_view;
  glm::vec3 m_viewInPanorama;
  LobeView m_atView;
  std::optional<StretchedAxes> m_axes; // in the panorama's frame
  bool m_isGlossy;
  std::optional<Reflection> m_reflection; // with shadows
  bool m_folds = false;                   // part of the lobe goes below the horizon
  // Of the specular lobe, what is in closed form beside diffuse light: it times NoL.
  glm::dvec3 m_spread{0.0};
  std::uint32_t m_seed;
  std::optional<ProductSampler> m_product;
  std::optional<LinearControl> m_control;
  std::array<bool, kWays> m_uses{};
};

} // namespace

Integral integrateEnvironment(const SurfaceSample& sample, const Lobes& lobes, const EnvironmentSampler& environment,
                              const glm::dvec3& otherLight, const IntegralOptions& options,
                              const PointVisibility& fromHere, const glm::dvec3& besides, const glm::dvec3& weight) {
  if (environment.isBlack()) return {};
  EnvironmentIntegrator integrator(sample, lobes, environment, options.seed, fromHere);
  Integral known = integrator.inClosedForm();
  if (!integrator.needsSamples()) return known;
  integrator.prepareSampling(known.diffuse + known.specular + besides);
  known.specular += integrator.controlled();
  Integral result = sumReplicates(
      options,
      [&](Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) {
        integrator.add(sum, replicate, begin, end);
      },
      [&](const Integral& now) {
        const glm::dvec3 light = now.diffuse + now.specular + known.diffuse + known.specular;
        return largest(weight * now.standardError) <= options.relativeError * largest(weight * light + otherLight);
      });
  result.diffuse += known.diffuse;
  result.specular += known.specular;
  return result;
}

} // namespace parity::reference
