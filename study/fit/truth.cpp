// The truth of the fits (see truth.h).
#include "study/fit/truth.h"

#include "reference/fresnel.h"
#include "shading/shading.h"

namespace parity::fit {

namespace f64 = shading::f64;

Truth::Truth(const Settings& settings) : m_settings(settings), m_albedo(settings.geometryTerm, settings.fresnel) {}

Truth Truth::with(Compensation compensation) const {
  Truth other = *this;
  other.m_settings.compensation = compensation;
  return other;
}

std::vector<Point> Truth::pointsOf(Domain domain, int n) const {
  const double leastRoughness = domain == Domain::full ? 1.0 / 64 : 0.05;
  const double leastNoV = domain == Domain::full ? 1.0 / 256 : 0.05;
  std::vector<Point> points;
  for (int i = 0; i < n; ++i) {
    const double roughness = leastRoughness + (1 - leastRoughness) * (i + 0.5) / n;
    const reference::AlbedoRow row = m_albedo.row(roughness);
    for (int k = 0; k < n; ++k) {
      const double NoV = leastNoV + (1 - leastNoV) * (k + 0.5) / n;
      const double E = row.at(NoV), B = E * row.fresnelWeightAt(NoV);
      points.push_back({roughness, NoV, E - B, B, 1 - row.average()});
    }
  }
  return points;
}

double Truth::multiple(const Point& p, double F0) const {
  const f64::real3 color(F0, F0, F0);
  const f64::real2 dfg(p.A, p.B);
  const f64::real3 mean = f64::mixFresnel(color, 1, reference::fresnelMean(m_settings.fresnel));
  switch (m_settings.compensation) {
  case Compensation::turquin:
    return single(p, F0) * (f64::energyCompensation(color, dfg).x - 1);
  case Compensation::fdezAguera:
    return f64::fdezAgueraAlbedo(color, 1, mean, dfg).x;
  case Compensation::kullaConty:
    return f64::kullaContyAlbedo(mean, p.A + p.B, 1 - p.lostAverage).x;
  default:
    return 0;
  }
}

double Truth::spread() const {
  if (m_settings.compensation == Compensation::fdezAguera) return 1;
  if (m_settings.compensation != Compensation::kullaConty) return 0;
  // g + 3/2 (1 - g) N = 3/2 N + g (1 - 3/2 N): one unknown.
  double above = 0, below = 0;
  for (const Point& p : pointsOf(Domain::full, 64)) {
    const double weight = p.NoV * p.lostAverage, slope = 1 - 1.5 * p.NoV; // times lostAverage again, in the lobe
    above += weight * slope * (p.lost() - 1.5 * p.NoV * p.lostAverage);
    below += weight * slope * slope * p.lostAverage;
  }
  return above / below;
}

} // namespace parity::fit
