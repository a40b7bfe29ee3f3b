#include "highend/table_brdf.h"

#include <algorithm>

#include <fmt/format.h>

#include "shading/shading.h"

namespace parity::highend {

namespace f64 = shading::f64;

namespace {

// Of the path's shader: grazing and back-facing normals take the lobe of the last visible direction.
constexpr double kMinNoV = 1e-4;

f64::real3 fromGlm(const glm::dvec3& v) { return {v.x, v.y, v.z}; }
glm::dvec3 toGlm(const f64::real3& v) { return {v.x, v.y, v.z}; }

double fresnelMean(FresnelCurve curve) {
  if (curve == FresnelCurve::sphericalGaussian) return f64::sphericalGaussianMean();
  if (curve == FresnelCurve::dielectric) return f64::dielectricMean();
  return f64::schlickMean();
}

} // namespace

TableBrdf::TableBrdf(const Options& options)
    : m_options(options), m_lut(makeEnvBrdfLut(options.model.geometryTerm, options.model.fresnel, options.lutSize)) {}

paths::EnvBrdfWords TableBrdf::words() const {
  const auto nameOf = [](const std::vector<std::string>& names, auto value) {
    return names[static_cast<std::size_t>(value)];
  };
  return {.label = "table",
          .kind = "table",
          .variant = "table",
          .formula = fmt::format("{}, Fresnel {}", nameOf(geometryTermNames(), m_options.model.geometryTerm),
                                 nameOf(fresnelNames(), m_options.model.fresnel)),
          .numbers = fmt::format("{0} x {0}", m_options.lutSize),
          .multiple = nameOf(compensationNames(), m_options.compensation)};
}

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

paths::EnvBrdf::AB TableBrdf::at(double roughness, double NoV) const {
  const glm::dvec3 texel = read(roughness, NoV);
  return {texel.x, texel.y};
}

glm::dvec3 TableBrdf::once(const paths::EnvBrdfMaterial& material, double NoV) const {
  const AB e = at(material.roughness, NoV);
  return material.F0() * e.A + material.F90() * e.B;
}

glm::dvec3 TableBrdf::multiple(const paths::EnvBrdfMaterial& material, double NoV) const {
  const glm::dvec3 texel = read(material.roughness, NoV), F0 = material.F0();
  const double F90 = material.F90();
  const f64::real2 scaleAndBias(texel.x, texel.y);
  const f64::real3 mean = f64::mixFresnel(fromGlm(F0), F90, fresnelMean(m_options.model.fresnel));
  switch (m_options.compensation) {
  case Compensation::turquin:
    return (F0 * texel.x + F90 * texel.y) * (toGlm(f64::energyCompensation(fromGlm(F0), scaleAndBias)) - 1.0);
  case Compensation::fdezAguera:
    return toGlm(f64::fdezAgueraAlbedo(fromGlm(F0), F90, mean, scaleAndBias));
  case Compensation::kullaConty:
    return toGlm(f64::kullaContyAlbedo(mean, texel.x + texel.y, texel.z));
  case Compensation::none:
    break;
  }
  return glm::dvec3(0);
}

} // namespace parity::highend
