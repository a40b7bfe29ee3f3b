// The sheen's lobe: its albedo and its environment light against sums of the formula, written out here; its directions
// against their density.
#include "reference/sheen_lobe.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "reference/direction_density.h"
#include "reference/environment_integral.h"
#include "reference/sheen_albedo.h"
#include "reference/surroundings.h"
#include "shading/sheen_formula.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// Between the table's nodes. Observed: 4.5e-5 from NoV .002 on, and 4e-4 below; relative where it exceeds 1.
TEST(SheenAlbedo, IsTheIntegral) {
  const SheenAlbedo table;
  for (const double roughness : {0.07, 0.0763, 0.1, 0.161, 0.3, 0.497, 0.73, 1.0}) {
    for (const double NoV : {0.002, 0.013, 0.05, 0.12, 0.3, 0.61, 1.0}) {
      const double truth = tests::sheenAlbedoBySum(roughness, NoV, 400);
      EXPECT_NEAR(table.at(roughness, NoV), truth, 6e-5 * std::max(1.0, truth)) << roughness << ", " << NoV;
    }
    EXPECT_NEAR(table.at(roughness, 2e-4) / tests::sheenAlbedoBySum(roughness, 2e-4, 800), 1, 6e-4) << roughness;
  }
}

TEST(SheenAlbedo, IsAShareBetweenTheTablesEnds) {
  const SheenAlbedo table;
  double greatest = 0;
  for (int i = 0; i <= 100; ++i)
    for (int k = 0; k <= 100; ++k) {
      const double share = table.shareAt(0.01 * i, 0.01 * k);
      ASSERT_TRUE(share >= 0 && share <= 1) << i << ", " << k;
      greatest = std::max(greatest, table.at(0.01 * i, 0.01 * k));
    }
  EXPECT_GT(greatest, 2) << "the published shadowing lets out more than came in";
  EXPECT_EQ(table.at(0, 0.3), table.at(0.07, 0.3));
  EXPECT_EQ(table.at(0.5, 0), table.at(0.5, 1e-4));
}

TEST(SheenLobe, DirectionsFollowTheirDensity) {
  for (const double roughness : {0.25, 0.5, 1.0})
    for (const double NoV : {0.15, 0.6, 1.0}) {
      const SheenLobe lobe(glm::dvec3(1), roughness);
      const glm::dvec3 view(std::sqrt(1 - NoV * NoV), 0, NoV), below(0, 0, -1);
      const auto pdf = [&](const glm::dvec3& l) {
        const glm::dvec3 h = glm::normalize(view + l);
        return lobe.pdf(lobe.distribution(h.z), l.z, h.z, glm::dot(view, h));
      };
      const auto sample = [&](const glm::dvec2& u) { return lobe.sample(view, u).value_or(below); };
      std::mt19937_64 random(2);
      std::uniform_real_distribution<double> uniform;
      double upward = 0;
      for (int i = 0; i < 100000; ++i) {
        const double u = uniform(random), v = uniform(random);
        upward += sample(glm::dvec2(u, v)).z > 0 ? 1e-5 : 0;
      }
      SCOPED_TRACE(testing::Message() << "roughness " << roughness << ", NoV " << NoV);
      tests::expectDensity(sample, pdf, upward, 5 * 0.5 / std::sqrt(1e5));
    }
}

// A control variate and where samples go are made of it: it may be off, but not by much.
TEST(SheenLobe, EstimateIsAboutTheLobe) {
  for (const double roughness : {0.1, 0.3, 1.0})
    for (const double NoV : {0.03, 0.4, 1.0}) {
      const Lobes lobes(SheenLobe({0.9, 0.5, 0.2}, roughness));
      const glm::dvec3 view(std::sqrt(1 - NoV * NoV), 0, NoV);
      for (int i = 0; i < 100; ++i) {
        FourDirections four;
        std::array<glm::dvec3, 4> directions;
        for (int k = 0; k < 4; ++k) {
          const double z = (i + 0.5) / 100, phi = 2.4 * (4 * i + k), r = std::sqrt(1 - z * z);
          directions[k] = {r * std::cos(phi), r * std::sin(phi), z};
          for (int c = 0; c < 3; ++c)
            (c == 0 ? four.x : c == 1 ? four.y : four.z)[k] = static_cast<float>(directions[k][c]);
        }
        const auto estimate = lobes.estimateSpecular(four, {0, 0, 1}, glm::vec3(view), {});
        for (int k = 0; k < 4; ++k) {
          const glm::dvec3 exact = lobes.evaluate(view, directions[k], {}).specular;
          for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(estimate[static_cast<std::size_t>(c)][k], exact[c], 2e-2 * exact[c] + 1e-4)
                << roughness << ", " << NoV << ", NoL " << directions[k].z;
        }
      }
    }
}

// Over every cell of a panorama with a bright source, sub x sub parts of each.
double lightBySum(const scenes::Environment& environment, const SurfaceSample& sample, double roughness) {
  const tests::SheenFormula sheen(roughness);
  const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view));
  double sum = 0;
  for (int y = 0; y < tests::kPanoramaHeight / 2; ++y) // N = +Y: the upper half
    for (int x = 0; x < tests::kPanoramaWidth; ++x) {
      const double radiance = environment.radiance.at(x, y)[1];
      const int sub = radiance > 10 ? 8 : y > tests::kPanoramaHeight / 2 - 8 ? 4 : 1;
      for (int j = 0; j < sub; ++j)
        for (int i = 0; i < sub; ++i) {
          const glm::dvec3 L = tests::cellDirection(x + (i + 0.5) / sub - 0.5, y + (j + 0.5) / sub - 0.5);
          const double top = pi * (y + double(j) / sub) / tests::kPanoramaHeight;
          const double area = (std::cos(top) - std::cos(top + pi / sub / tests::kPanoramaHeight)) * 2 * pi / sub /
                              tests::kPanoramaWidth;
          const double NoL = glm::dot(N, L), NoV = glm::dot(N, V);
          sum += radiance * area * sheen.D(glm::dot(N, glm::normalize(V + L))) * sheen.V(NoV, NoL) * NoL;
        }
    }
  return sum;
}

TEST(SheenLobe, EnvironmentsLightIsTheSumOverAllCells) {
  const scenes::Environment environment = tests::makeSunnyPanorama();
  const EnvironmentSampler sky(environment);
  for (const double roughness : {0.07, 0.15, 0.3, 0.6, 1.0})
    for (const double NoV : {0.05, 0.3, 0.9}) {
      const SurfaceSample sample = tests::makePoint(NoV, 0.5f, 0);
      const double truth = lightBySum(environment, sample, roughness);
      const Lobes lobes(SheenLobe({0.25, 0.5, 1}, roughness));
      const Integral result = integrateEnvironment(sample, lobes, sky, glm::dvec3(0),
                                                   {.relativeError = 3e-4, .minSamples = 256, .maxSamples = 1 << 17});
      EXPECT_EQ(result.diffuse, glm::dvec3(0));
      // Five standard errors, and 1e-3 of the light for the sum over cells itself.
      EXPECT_NEAR(result.specular.y, 0.5 * truth, 5 * result.standardError.y + 5e-4 * truth)
          << "roughness " << roughness << ", NoV " << NoV << ", error " << result.standardError.y;
      EXPECT_LT(result.standardError.y, 1.5e-4 * truth + 1e-9) << roughness << ", " << NoV << ", " << result.samples;
    }
}

// Two seeds differ by what their errors say: z^2 of 30 degrees of freedom averages 1.07.
TEST(SheenLobe, ErrorsAreHonest) {
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  double squares = 0, worst = 0;
  constexpr int kPoints = 120;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    SurfaceSample sample = tests::makePoint(0.05 + 0.95 * (i % 12) / 12, 0.5f, 0);
    sample.pixel = i;
    const Lobes lobes(SheenLobe(glm::dvec3(1), 0.07 + 0.93 * (i % 10) / 10));
    const auto integrate = [&](std::uint32_t seed) {
      return integrateEnvironment(sample, lobes, sky, glm::dvec3(0),
                                  {.relativeError = 0, .minSamples = 512, .maxSamples = 512, .seed = seed});
    };
    const Integral a = integrate(1), b = integrate(2);
    const double z = (a.specular.y - b.specular.y) / std::hypot(a.standardError.y, b.standardError.y);
    squares += z * z;
    worst = std::max(worst, std::abs(z));
  }
  EXPECT_TRUE(squares / kPoints > 0.6 && squares / kPoints < 1.7) << squares / kPoints;
  EXPECT_LT(worst, 5.5);
}

} // namespace
} // namespace parity::reference
