#include "mobile/approximate_brdf.h"

#include <algorithm>

#include "shading/shading.h"

namespace parity::mobile {

namespace f64 = shading::f64;

namespace {

f64::real3 fromGlm(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

f64::MobileMaterial packed(const paths::EnvBrdfMaterial& material, double roughness) {
  f64::MobileMaterial m;
  m.BaseColor = fromGlm(material.baseColor);
  m.Metallic = material.metallic;
  m.DielectricSpecular = fromGlm(material.dielectric);
  m.F90 = material.dielectricF90;
  m.Roughness = roughness;
  return m;
}

// As the overrides of material quality have it.
paths::EnvBrdfMaterial overridden(paths::EnvBrdfMaterial material, const Options& options) {
  if (options.nonmetal) {
    material.metallic = 0;
    material.dielectric = glm::dvec3(0.04);
    material.dielectricF90 = 1;
    material.nonmetal = true;
  }
  material.fullyRough |= options.fullyRough;
  return material;
}

const char* describe(EnvironmentBrdf brdf) {
  switch (brdf) {
  case EnvironmentBrdf::karis2014:
    return "EnvBRDFApprox (Karis 2014)";
  case EnvironmentBrdf::ue4:
    return "EnvBRDFApprox, B is 0 below F0 = 2 % (UE4)";
  case EnvironmentBrdf::refit:
  case EnvironmentBrdf::own: // never here: SampledBrdf has those
    break;
  }
  return "refit (docs/refit.md)";
}

} // namespace

paths::EnvBrdfWords ApproximateBrdf::words() const {
  return {.label = "mobile",
          .kind = "approximation",
          .variant = m_options.preset,
          .formula = describe(m_options.environmentBrdf),
          .numbers = "in double",
          .multiple = m_options.environmentBrdf == EnvironmentBrdf::refit ? "refit" : "none"};
}

paths::EnvBrdf::AB ApproximateBrdf::at(double roughness, double NoV) const {
  const double floored = std::max(roughness, static_cast<double>(m_options.roughnessFloor));
  const f64::real2 scaleAndBias =
      f64::environmentBrdfAB(static_cast<int>(m_options.environmentBrdf), false, {1, 1, 1}, floored, NoV);
  return {scaleAndBias.x, scaleAndBias.y};
}

glm::dvec3 ApproximateBrdf::once(const paths::EnvBrdfMaterial& given, double NoV) const {
  const paths::EnvBrdfMaterial material = overridden(given, m_options);
  const double floored = std::max(material.roughness, static_cast<double>(m_options.roughnessFloor));
  const f64::MobileShadingModelContext context =
      f64::initShadingModelContext(static_cast<int>(m_options.environmentBrdf), material.nonmetal, material.fullyRough,
                                   packed(material, floored), NoV);
  return material.fullyRough ? 0.45 * toGlm(context.SpecPreEnvBrdf) : toGlm(context.SpecularColor);
}

glm::dvec3 ApproximateBrdf::multiple(const paths::EnvBrdfMaterial& given, double NoV) const {
  const paths::EnvBrdfMaterial material = overridden(given, m_options);
  if (m_options.environmentBrdf != EnvironmentBrdf::refit || material.fullyRough) return glm::dvec3(0);
  return toGlm(f64::initShadingModelContext(f64::kEnvironmentBrdfRefit, material.nonmetal, false,
                                            packed(material, material.roughness), NoV)
                   .lobe.multiple);
}

std::string ApproximateBrdf::form(const paths::EnvBrdfMaterial& given) const {
  const paths::EnvBrdfMaterial material = overridden(given, m_options);
  return material.fullyRough ? "fully rough" : material.nonmetal ? "nonmetal" : "general";
}

} // namespace parity::mobile
