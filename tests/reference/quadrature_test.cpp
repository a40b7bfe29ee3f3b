// Multiple importance sampling against a sum over every cell of the panorama, with textbook formulas.
#include <gtest/gtest.h>

#include "reference/environment_integral.h"
#include "reference/surroundings.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

constexpr double kPi = std::numbers::pi;

// The sum over cells, each in `sub` x `sub` parts: finer where the lobe or the bright source asks for it.
struct BruteForce {
  double diffuse = 0, specular = 0;
};
BruteForce integrate(const scenes::Environment& environment, const SurfaceSample& sample, double F0, double F90) {
  const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view));
  const glm::dvec3 R = 2 * glm::dot(N, V) * N - V;
  const double alpha = double(sample.roughness) * double(sample.roughness), NoV = glm::dot(N, V);
  const double albedo = sample.baseColor.y * (1.0 - sample.metallic);
  BruteForce sum;
  for (int y = 0; y < tests::kPanoramaHeight / 2; ++y) // N = +Y: the upper half
    for (int x = 0; x < tests::kPanoramaWidth; ++x) {
      const double radiance = environment.radiance.at(x, y)[1];
      const bool fine = radiance > 10 || glm::dot(R, tests::cellDirection(x, y)) > std::cos(30 * alpha + 0.02);
      const int sub = fine ? (alpha < 0.05 ? 16 : 4) : 1;
      for (int j = 0; j < sub; ++j)
        for (int i = 0; i < sub; ++i) {
          const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5);
          const double top = kPi * (y + double(j) / sub) / tests::kPanoramaHeight;
          const double area = (std::cos(top) - std::cos(top + kPi / sub / tests::kPanoramaHeight)) * 2 * kPi / sub /
                              tests::kPanoramaWidth;
          const double NoL = glm::dot(N, L);
          if (!(NoL > 0)) continue;
          const glm::dvec3 H = glm::normalize(V + L);
          const double F = F0 + (F90 - F0) * std::pow(1 - glm::dot(V, H), 5);
          sum.diffuse += radiance * area * albedo / kPi * NoL;
          sum.specular += radiance * area * F * tests::distribution(alpha, glm::dot(N, H)) *
                          tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, NoL) / (4 * NoV);
        }
    }
  return sum;
}

// Rough and smooth, metal and plastic, the lobe beside and on the bright source.
TEST(MultipleImportanceSampling, agreesWithASumOverAllCells) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  const EnvironmentSampler sky(environment);
  const glm::dvec3 sun = glm::normalize(glm::dvec3(0.4, 0.7, 0.5)), mirrored(-sun.x, sun.y, -sun.z);
  struct Case {
    glm::dvec3 view;
    float roughness, metallic;
  };
  for (const Case& c : {Case{{0.6, 0.8, 0}, 0.15f, 1}, Case{{0.6, 0.8, 0}, 0.35f, 0}, Case{{0.6, 0.8, 0}, 0.9f, 0},
                        Case{{0.95, 0.31, 0}, 0.5f, 1}, Case{mirrored, 0.15f, 1}, Case{mirrored, 0.2f, 0},
                        Case{mirrored, 0.6f, 0}, Case{glm::normalize(mirrored + glm::dvec3(0.05, 0, 0)), 0.3f, 0.5f}}) {
    SurfaceSample sample = tests::makePoint(1, c.roughness, c.metallic);
    sample.view = glm::vec3(glm::normalize(c.view));
    sample.baseColor = glm::vec3(0.7f);
    const double F0 = 0.04f * (1.0 - c.metallic) + 0.7f * c.metallic;
    const BruteForce truth = integrate(environment, sample, F0, 1);
    const Integral result = integrateEnvironment(sample, Lobes(sample, tests::plainModel(), c.roughness, nullptr), sky,
                                                 glm::dvec3(0), {.relativeError = 2e-4, .maxSamples = 1 << 17});
    SCOPED_TRACE(testing::Message() << "roughness " << c.roughness << ", metallic " << c.metallic << ", view "
                                    << c.view.x);
    const double total = truth.diffuse + truth.specular;
    // Five standard errors, and 5e-4 for the sum over cells itself.
    EXPECT_NEAR(result.diffuse.y + result.specular.y, total, 5 * result.standardError.y + 5e-4 * total);
    EXPECT_NEAR(result.diffuse.y, truth.diffuse, 2e-3 * total);
    EXPECT_NEAR(result.specular.y, truth.specular, 2e-3 * total);
  }
}

} // namespace
} // namespace parity::reference
