#include "study/plot/env_brdf.h"

#include <algorithm>
#include <cmath>

namespace parity::plot {

namespace f64 = shading::f64;

namespace {

// Of the high-end shader: grazing and back-facing normals take the lobe of the last visible direction.
constexpr double kMinNoV = 1e-4;

f64::real3 fromGlm(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

double fresnelMean(highend::FresnelCurve curve) {
  if (curve == highend::FresnelCurve::sphericalGaussian) return f64::sphericalGaussianMean();
  if (curve == highend::FresnelCurve::dielectric) return f64::dielectricMean();
  return f64::schlickMean();
}

// A metal whose base colour is its F0.
f64::MobileMaterial metalOf(double roughness, const glm::dvec3& F0) {
  f64::MobileMaterial material;
  material.BaseColor = fromGlm(F0);
  material.Metallic = 1;
  material.DielectricSpecular = {0.04, 0.04, 0.04};
  material.F90 = 1;
  material.Roughness = roughness;
  return material;
}

} // namespace

TableBrdf::TableBrdf(const highend::Options& options)
    : m_options(options), m_lut(highend::makeEnvBrdfLut(options.model.geometryTerm, options.model.fresnel)) {}

glm::dvec3 TableBrdf::read(double roughness, double NoV) const {
  const double x = std::clamp(NoV, kMinNoV, 1.0) * (m_lut.width - 1),
               y = std::clamp(roughness, 0.0, 1.0) * (m_lut.height - 1);
  const int x0 = std::min(static_cast<int>(x), m_lut.width - 2), y0 = std::min(static_cast<int>(y), m_lut.height - 2);
  glm::dvec3 sum(0);
  for (const int j : {0, 1})
    for (const int i : {0, 1}) {
      const float* texel = m_lut.at(x0 + i, y0 + j);
      sum += (i ? x - x0 : 1 - (x - x0)) * (j ? y - y0 : 1 - (y - y0)) * glm::dvec3(texel[0], texel[1], texel[2]);
    }
  return sum;
}

EnvBrdf TableBrdf::at(double roughness, double NoV) const {
  const glm::dvec3 texel = read(roughness, NoV);
  return {texel.x, texel.y};
}

glm::dvec3 TableBrdf::once(double roughness, double NoV, const glm::dvec3& F0, double F90) const {
  const EnvBrdf e = at(roughness, NoV);
  return F0 * e.A + F90 * e.B;
}

glm::dvec3 TableBrdf::multiple(double roughness, double NoV, const glm::dvec3& F0, double F90) const {
  const glm::dvec3 texel = read(roughness, NoV);
  const f64::real2 AB(texel.x, texel.y);
  const f64::real3 mean = f64::mixFresnel(fromGlm(F0), F90, fresnelMean(m_options.model.fresnel));
  switch (m_options.compensation) {
  case highend::Compensation::turquin:
    return (F0 * AB.x + F90 * AB.y) * (toGlm(f64::energyCompensation(fromGlm(F0), AB)) - 1.0);
  case highend::Compensation::fdezAguera:
    return toGlm(f64::fdezAgueraAlbedo(fromGlm(F0), F90, mean, AB));
  case highend::Compensation::kullaConty:
    return toGlm(f64::kullaContyAlbedo(mean, AB.x + AB.y, texel.z));
  case highend::Compensation::none:
    break;
  }
  return glm::dvec3(0);
}

EnvBrdf ApproximateBrdf::at(double roughness, double NoV) const {
  const double floored = std::max(roughness, static_cast<double>(m_options.roughnessFloor));
  const f64::real2 AB =
      f64::environmentBrdfAB(static_cast<int>(m_options.environmentBrdf), false, {1, 1, 1}, floored, NoV);
  return {AB.x, AB.y};
}

glm::dvec3 ApproximateBrdf::once(double roughness, double NoV, const glm::dvec3& F0) const {
  return once(metalOf(roughness, F0), false, false, NoV);
}

glm::dvec3 ApproximateBrdf::multiple(double roughness, double NoV, const glm::dvec3& F0) const {
  return multiple(metalOf(roughness, F0), false, false, NoV);
}

glm::dvec3 ApproximateBrdf::once(const f64::MobileMaterial& material, bool nonmetal, bool fullyRough,
                                 double NoV) const {
  f64::MobileMaterial m = material;
  m.Roughness = std::max(m.Roughness, static_cast<double>(m_options.roughnessFloor));
  const f64::MobileShadingModelContext context =
      f64::initShadingModelContext(static_cast<int>(m_options.environmentBrdf), nonmetal, fullyRough, m, NoV);
  return fullyRough ? 0.45 * toGlm(context.SpecPreEnvBrdf) : toGlm(context.SpecularColor);
}

glm::dvec3 ApproximateBrdf::multiple(const f64::MobileMaterial& material, bool nonmetal, bool fullyRough,
                                     double NoV) const {
  if (m_options.environmentBrdf != mobile::EnvironmentBrdf::refit || fullyRough) return glm::dvec3(0);
  return toGlm(f64::initShadingModelContext(f64::kEnvironmentBrdfRefit, nonmetal, false, material, NoV).lobe.multiple);
}

std::string ApproximateBrdf::formula() const {
  switch (m_options.environmentBrdf) {
  case mobile::EnvironmentBrdf::karis2014:
    return "EnvBRDFApprox (Karis 2014)";
  case mobile::EnvironmentBrdf::ue4:
    return "EnvBRDFApprox, B off below F0 = 2 % (UE4)";
  case mobile::EnvironmentBrdf::refit:
    break;
  }
  return "refit (docs/refit.md)";
}

Deviation deviationOf(const TableBrdf& table, const ApproximateBrdf& approximate, double F0) {
  constexpr int kCells = 96;
  Deviation deviation;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      const double roughness = 0.05 + 0.95 * (j + 0.5) / kCells, NoV = 0.05 + 0.95 * (i + 0.5) / kCells;
      const glm::dvec3 color(F0);
      const double error = approximate.once(roughness, NoV, color).x - table.once(roughness, NoV, color).x;
      deviation.max = std::max(deviation.max, std::abs(error));
      deviation.rms += error * error;
    }
  deviation.rms = std::sqrt(deviation.rms / (kCells * kCells));
  return deviation;
}

} // namespace parity::plot
