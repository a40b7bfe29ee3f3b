// The environment's light against a sum over every cell of the panorama, with textbook formulas.
#include <numbers>

#include <gtest/gtest.h>

#include "reference/environment_integral.h"
#include "reference/surroundings.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// Kulla and Conty's lobe and the diffuse one that the specular leaves, written out here with the albedos by quadrature.
class Textbook {
public:
  Textbook(double roughness, double F0, bool isWhole) : m_alpha(roughness * roughness), m_F0(F0) {
    if (!isWhole) return;
    for (int i = 0; i <= kSteps; ++i) {
      const double mu = std::max(1e-4, double(i * i) / (kSteps * kSteps));
      const tests::EnvBrdf E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, roughness, mu);
      m_lost.push_back(1 - E.A - E.B);
      m_first.push_back(F0 * E.A + E.B);
    }
    const tests::GaussRule gauss(64);
    double lost = 0;
    for (std::size_t i = 0; i < gauss.nodes.size(); ++i) {
      const double mu = 0.5 * (1 + gauss.nodes[i]);
      lost += gauss.weights[i] * mu * at(m_lost, mu);
    }
    const double Favg = F0 + (1 - F0) / 21; // Schlick's curve
    m_multiple = Favg * Favg * (1 - lost) / (1 - Favg * lost) / (pi * lost);
    m_lostAverage = lost;
  }

  double specular(double NoV, double NoL, double NoH, double VoH) const {
    const double F = m_F0 + (1 - m_F0) * std::pow(1 - VoH, 5);
    const double once = F * tests::distribution(m_alpha, NoH) *
                        tests::maskingShadowing(tests::Geometry::heightCorrelated, m_alpha, NoV, NoL) / (4 * NoV);
    return m_lost.empty() ? once : once + m_multiple * at(m_lost, NoV) * at(m_lost, NoL) * NoL;
  }
  // What is left for the diffuse lobe.
  double rest(double NoV) const {
    return m_lost.empty() ? 1 : 1 - at(m_first, NoV) - m_multiple * pi * m_lostAverage * at(m_lost, NoV);
  }

private:
  static constexpr int kSteps = 128;
  double at(const std::vector<double>& nodes, double mu) const {
    const double place = std::sqrt(mu) * kSteps;
    const int i = std::min(static_cast<int>(place), kSteps - 1);
    return glm::mix(nodes[i], nodes[i + 1], place - i);
  }
  double m_alpha, m_F0, m_multiple = 0, m_lostAverage = 1;
  std::vector<double> m_lost, m_first; // over sqrt(mu)
};

// The sum over cells, each in `sub` x `sub` parts: finer where the lobe or the bright source asks for it.
struct BruteForce {
  double diffuse = 0, specular = 0;
};
BruteForce integrate(const scenes::Environment& environment, const SurfaceSample& sample, const Textbook& textbook) {
  const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view));
  const glm::dvec3 R = 2 * glm::dot(N, V) * N - V;
  const double alpha = double(sample.roughness) * double(sample.roughness), NoV = glm::dot(N, V);
  const double albedo = sample.baseColor.y * (1.0 - sample.metallic) * textbook.rest(NoV);
  BruteForce sum;
  for (int y = 0; y < tests::kPanoramaHeight / 2; ++y) // N = +Y: the upper half
    for (int x = 0; x < tests::kPanoramaWidth; ++x) {
      const double radiance = environment.radiance.at(x, y)[1];
      const bool fine = radiance > 10 || glm::dot(R, tests::cellDirection(x, y)) > std::cos(30 * alpha + 0.02);
      const int sub = fine ? (alpha < 0.05 ? 16 : 4) : 1;
      for (int j = 0; j < sub; ++j)
        for (int i = 0; i < sub; ++i) {
          const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5);
          const double top = pi * (y + double(j) / sub) / tests::kPanoramaHeight;
          const double area = (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub /
                              tests::kPanoramaWidth;
          const double NoL = glm::dot(N, L);
          if (!(NoL > 0)) continue;
          const glm::dvec3 H = glm::normalize(V + L);
          sum.diffuse += radiance * area * albedo / pi * NoL;
          sum.specular += radiance * area * textbook.specular(NoV, NoL, glm::dot(N, H), glm::dot(V, H));
        }
    }
  return sum;
}

struct Case {
  glm::dvec3 view;
  float roughness, metallic;
};

void expectAgreement(const scenes::Environment& environment, const std::vector<Case>& cases, const Model& model,
                     const DirectionalAlbedo* table) {
  const EnvironmentSampler sky(environment);
  for (const Case& c : cases) {
    SurfaceSample sample = tests::makePoint(1, c.roughness, c.metallic);
    sample.view = glm::vec3(glm::normalize(c.view));
    sample.baseColor = glm::vec3(0.7f);
    const Textbook textbook(c.roughness, 0.04f * (1.0 - c.metallic) + 0.7f * c.metallic, table != nullptr);
    const BruteForce truth = integrate(environment, sample, textbook);
    const Integral result = integrateEnvironment(sample, Lobes(sample, model, c.roughness, table), sky, glm::dvec3(0),
                                                 {.relativeError = 2e-4, .maxSamples = 1 << 17});
    SCOPED_TRACE(testing::Message() << "roughness " << c.roughness << ", metallic " << c.metallic << ", view "
                                    << c.view.x);
    const double total = truth.diffuse + truth.specular;
    // Five standard errors, and 5e-4 for the sum over cells itself; diffuse light has no noise.
    EXPECT_NEAR(result.diffuse.y + result.specular.y, total, 5 * result.standardError.y + 5e-4 * total);
    EXPECT_NEAR(result.diffuse.y, truth.diffuse, 1e-4 * truth.diffuse);
    EXPECT_NEAR(result.specular.y, truth.specular, 5 * result.standardError.y + 5e-4 * total);
  }
}

const glm::dvec3 kSun = glm::normalize(glm::dvec3(0.4, 0.7, 0.5)), kMirrored(-kSun.x, kSun.y, -kSun.z);

// Rough and smooth, metal and plastic, the lobe beside and on the bright source.
TEST(EnvironmentIntegral, AgreesWithASumOverAllCells) {
  const Case cases[] = {{{0.6, 0.8, 0}, 0.15f, 1}, {{0.6, 0.8, 0}, 0.35f, 0},
                        {{0.6, 0.8, 0}, 0.9f, 0},  {{0.95, 0.31, 0}, 0.5f, 1},
                        {kMirrored, 0.15f, 1},     {kMirrored, 0.2f, 0},
                        {kMirrored, 0.6f, 0},      {glm::normalize(kMirrored + glm::dvec3(0.05, 0, 0)), 0.3f, 0.5f}};
  expectAgreement(tests::makeSunnyPanorama(), {std::begin(cases), std::end(cases)}, tests::plainModel(), nullptr);
}

// Light that scatters more than once, and the diffuse lobe that the specular one leaves, both in part in closed form.
TEST(EnvironmentIntegral, AgreesWithASumOverAllCellsForTheWholeModel) {
  const Case cases[] = {{{0.6, 0.8, 0}, 0.2f, 1}, {{0.6, 0.8, 0}, 1.f, 1},     {{0.98, 0.2, 0}, 0.7f, 1},
                        {kMirrored, 0.5f, 1},     {{0.6, 0.8, 0}, 0.1f, 0},    {{0.98, 0.2, 0}, 0.4f, 0},
                        {kMirrored, 0.8f, 0},     {{0.3, 0.95, 0}, 0.6f, 0.5f}};
  const DirectionalAlbedo table(GeometryTerm::heightCorrelated);
  expectAgreement(tests::makeSunnyPanorama(), {std::begin(cases), std::end(cases)}, Model{}, &table);
}

// A dim room with softboxes, strips and lamps of few texels, one of them a single one.
TEST(EnvironmentIntegral, AgreesWithASumOverAllCellsAmongLamps) {
  const DirectionalAlbedo table(GeometryTerm::heightCorrelated);
  scenes::Environment room = tests::makePanorama([](const glm::dvec3& d) {
    const float wall = 0.05f + 0.03f * static_cast<float>(std::sin(9 * d.x) * std::sin(7 * d.z));
    return glm::vec3(std::abs(d.x - 0.5) < 0.2 && std::abs(d.z + 0.3) < 0.15 && d.y > 0 ? 12.f : wall);
  });
  for (int x = 200; x < 330; ++x) room.radiance.at(x, 150)[1] = 60;
  for (int x = 700; x < 703; ++x)
    for (int y = 90; y < 92; ++y) room.radiance.at(x, y)[1] = 5000;
  room.radiance.at(100, 252)[1] = 20000; // near the horizon
  const Case cases[] = {{{0.6, 0.8, 0.1}, 0.1f, 1}, {{0.6, 0.8, 0.1}, 0.25f, 1},  {{0.6, 0.8, 0.1}, 0.6f, 1},
                        {{0.1, 0.9, 0}, 1.f, 1},    {{-0.5, 0.8, 0.3}, 0.15f, 0}, {{-0.5, 0.8, 0.3}, 0.3f, 0},
                        {{-0.9, 0.2, 0}, 0.3f, 1},  {{0.2, 0.5, 0.7}, 0.8f, 0}};
  expectAgreement(room, {std::begin(cases), std::end(cases)}, Model{}, &table);
}

} // namespace
} // namespace parity::reference
