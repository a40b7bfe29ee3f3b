#include "reference/environment_integral.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "reference/direct_light.h"
#include "reference/point_visibility.h"
#include "reference/sampling.h"

namespace parity::reference {

namespace {

// Axes of a right-handed frame around n (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
struct Frame {
  glm::dvec3 x, y, z;
  explicit Frame(const glm::dvec3& n) : z(n) {
    const double s = n.z >= 0 ? 1 : -1, a = -1 / (s + n.z), b = n.x * n.y * a;
    x = {1 + s * n.x * n.x * a, s * b, -s * n.x};
    y = {b, s + n.y * n.y * a, -n.y};
  }
  glm::dvec3 toLocal(const glm::dvec3& v) const { return {glm::dot(v, x), glm::dot(v, y), glm::dot(v, z)}; }
  glm::dvec3 toWorld(const glm::dvec3& v) const { return x * v.x + y * v.y + z * v.z; }
};

glm::dvec3 visibleView(const glm::dvec3& local) {
  if (local.z >= kMinNoV) return local;
  const double length = std::hypot(local.x, local.y), rest = std::sqrt(1 - kMinNoV * kMinNoV);
  return length > 0 ? glm::dvec3(local.x / length * rest, local.y / length * rest, kMinNoV)
                    : glm::dvec3(rest, 0, kMinNoV);
}

struct Sum {
  glm::dvec3 diffuse{0.0}, specular{0.0};
};

enum Way { kByEnvironment, kByCosine, kByVisibleNormal, kWays };

class Integrator {
public:
  Integrator(const SurfaceSample& sample, const Lobes& lobes, const EnvironmentSampler& environment, std::uint32_t seed,
             const lighting::Visibility* visibility)
      : m_lobes(lobes), m_environment(environment), m_fromHere(visibility, sample),
        m_frame(glm::normalize(glm::dvec3(sample.normal))),
        m_view(visibleView(m_frame.toLocal(glm::normalize(glm::dvec3(sample.view))))), m_atView(lobes.viewAt(m_view.z)),
        m_seed(hashCombine(sample.pixel, seed)) {
    const bool glossy = lobes.hasSpecular() && !lobes.isMirror();
    // Wide lobes, and the nearly diffuse light that scatters more than once, profit from the cosine.
    constexpr double kWideAlpha = 0.1;
    m_uses[kByEnvironment] = lobes.hasDiffuse() || glossy;
    m_uses[kByCosine] = lobes.hasDiffuse() || (glossy && lobes.alpha() > kWideAlpha);
    m_uses[kByVisibleNormal] = glossy;
  }

  bool needsSamples() const { return m_uses[kByEnvironment]; }

  glm::dvec3 reflectedByMirror() const {
    const glm::dvec3 mirrored = m_frame.toWorld({-m_view.x, -m_view.y, m_view.z});
    if (!m_fromHere.reaches(mirrored)) return glm::dvec3(0.0);
    return m_lobes.fresnel(m_view.z) * m_environment.evaluate(mirrored).radiance;
  }

  // Points [begin, end) of one replicate, all ways.
  void add(Sum& sum, int replicate, std::uint32_t begin, std::uint32_t end) const {
    for (int way = 0; way < kWays; ++way) {
      if (!m_uses[way]) continue;
      const std::uint32_t seed = hashCombine(m_seed, static_cast<std::uint32_t>(replicate * kWays + way));
      for (std::uint32_t i = begin; i < end; ++i) addPoint(sum, way, sobolPoint(i, seed));
    }
  }

private:
  void addPoint(Sum& sum, int way, const glm::dvec2& u) const {
    EnvironmentSample light;
    glm::dvec3 local;
    if (way == kByEnvironment) {
      light = m_environment.sample(u);
      local = m_frame.toLocal(light.direction);
    } else if (way == kByCosine) {
      local = sampleCosine(u);
    } else {
      const glm::dvec3 h = sampleVisibleNormal(m_lobes.alpha(), m_view, u);
      local = 2 * glm::dot(m_view, h) * h - m_view;
    }
    if (!(local.z > 0)) return;
    if (way != kByEnvironment) light = m_environment.evaluate(m_frame.toWorld(local));
    if (!m_fromHere.reaches(light.direction)) return;
    const LobeValues values = m_lobes.evaluate(m_view, local, m_atView);
    const double pdf = (m_uses[kByEnvironment] ? light.pdf : 0) + (m_uses[kByCosine] ? pdfCosine(local.z) : 0) +
                       (m_uses[kByVisibleNormal] ? values.pdfSpecular : 0);
    if (!(pdf > 0)) return; // a rounding off the support of all
    sum.diffuse += values.diffuse * light.radiance / pdf;
    sum.specular += values.specular * light.radiance / pdf;
  }

  const Lobes& m_lobes;
  const EnvironmentSampler& m_environment;
  PointVisibility m_fromHere;
  Frame m_frame;
  glm::dvec3 m_view;
  LobeView m_atView;
  std::uint32_t m_seed;
  std::array<bool, kWays> m_uses{};
};

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// Mean over the replicates, `points` each, and its standard error.
Integral estimate(const std::array<Sum, kReplicates>& sums, std::uint32_t points) {
  Integral result;
  for (const Sum& s : sums) {
    result.diffuse += s.diffuse;
    result.specular += s.specular;
  }
  const double scale = 1.0 / points;
  result.diffuse *= scale / kReplicates;
  result.specular *= scale / kReplicates;
  glm::dvec3 squares(0.0);
  for (const Sum& s : sums) {
    const glm::dvec3 d = (s.diffuse + s.specular) * scale - (result.diffuse + result.specular);
    squares += d * d;
  }
  result.standardError = glm::sqrt(squares / (kReplicates * (kReplicates - 1.0)));
  result.samples = static_cast<int>(points) * kReplicates;
  return result;
}

} // namespace

Integral integrateEnvironment(const SurfaceSample& sample, const Lobes& lobes, const EnvironmentSampler& environment,
                              const glm::dvec3& otherLight, const IntegralOptions& options,
                              const lighting::Visibility* visibility) {
  Integral result;
  if (environment.isBlack()) return result;
  const Integrator integrator(sample, lobes, environment, options.seed, visibility);
  const glm::dvec3 mirrored =
      lobes.hasSpecular() && lobes.isMirror() ? integrator.reflectedByMirror() : glm::dvec3(0.0);
  if (integrator.needsSamples()) {
    std::array<Sum, kReplicates> sums{};
    const auto pointsOf = [](int samples) {
      return std::bit_ceil(static_cast<std::uint32_t>(std::max(1, (samples + kReplicates - 1) / kReplicates)));
    };
    const std::uint32_t most = std::max(pointsOf(options.maxSamples), pointsOf(options.minSamples));
    std::uint32_t done = 0;
    for (std::uint32_t wanted = pointsOf(options.minSamples); wanted <= most; wanted *= 2) {
      for (int r = 0; r < kReplicates; ++r) integrator.add(sums[r], r, done, wanted);
      done = wanted;
      result = estimate(sums, done);
      const double shown = largest(result.diffuse + result.specular + mirrored + otherLight);
      if (largest(result.standardError) <= options.relativeError * shown) break;
    }
  }
  result.specular += mirrored;
  return result;
}

} // namespace parity::reference
