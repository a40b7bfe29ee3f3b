// Light through bodies whose paths are known: slabs, spheres, what lies within and behind.
#include "reference/body_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "base/parallel.h"
#include "reference/passed_through.h"
#include "reference/replicates.h"
#include "reference/sampling.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

class BodyTest : public PassedThroughTest {
protected:
  // Fresnel's reflectance of glass, from both polarisations.
  static double reflectance(double eta, double c) {
    const double sin2 = (1 - c * c) / (eta * eta);
    if (sin2 >= 1) return 1;
    const double t = std::sqrt(1 - sin2), s = (c - eta * t) / (c + eta * t), p = (eta * c - t) / (eta * c + t);
    return 0.5 * (s * s + p * p);
  }
  // Wide, from y = -thickness to 0.
  static scenes::Scene slab(float thickness) {
    scenes::Scene scene;
    tests::addObject(scene, scenes::makeBox({-8, -thickness, -8}, {8, 0, 8}), glass());
    return scene;
  }
  static scenes::Scene ball(int segments = 768) {
    scenes::Scene scene;
    tests::addObject(scene, scenes::makeSphere(1, segments, segments / 2), glass());
    return scene;
  }
  static Integral through(const SurfaceSample& sample, const lighting::Visibility& bodies,
                          const EnvironmentSampler* sky, const Surroundings* behind = nullptr,
                          const IntegralOptions& options = {}) {
    const Lobes lobes(sample, Model{}, sample.roughness, &albedo());
    return integrateBody(sample, lobes, {bodies, sky, behind, 1}, glm::dvec3(0), options);
  }
};

// Of a slab light comes from below after an even number of reflections within, from above after an odd one:
//   (1 - F) sum F^2k (K^(2k+1) A + F K^(2k+2) B)
TEST_F(BodyTest, SlabAbsorbsAndReflectsAsTheSeriesSays) {
  const scenes::Scene scene = slab(0.5f);
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  const glm::dvec3 A(1, 2, 3), B(7, 5, 4);
  const EnvironmentSampler sky(tests::makePanorama([&](const glm::dvec3& d) { return glm::vec3(d.y < 0 ? A : B); }));
  for (const float ior : {1.f, 1.5f, 2.4f})
    for (const double NoV : {1.0, 0.5}) {
      SurfaceSample sample = pane(NoV, 0);
      sample.thickness = 3; // that of the mesh counts
      sample.ior = ior;
      sample.absorption = {0, 0.5f, 2};
      const Integral light = through(sample, bodies, &sky);
      const double within = std::sqrt(1 - (1 - NoV * NoV) / (ior * ior)), F = reflectance(1 / ior, within);
      for (int c = 0; c < 3; ++c) {
        const double K = std::exp(-sample.absorption[c] * 0.5 / within);
        double sum = 0;
        for (int k = 0; k < 20; ++k)
          sum += (1 - F) * std::pow(F, 2 * k) * (std::pow(K, 2 * k + 1) * A[c] + F * std::pow(K, 2 * k + 2) * B[c]);
        EXPECT_NEAR(light.specular[c], sum, 1e-4 * sum) << ior << ", " << NoV << ", channel " << c;
      }
      EXPECT_LT(largest(light.standardError), 1e-9) << "nothing is drawn";
    }
}

// A ray that leaves a ball after k reflections within has turned by 2 (ti - tt) + k (pi - 2 tt) in its plane.
glm::dvec3 ballLight(const glm::dvec3& V, const glm::dvec3& N, double ior, const EnvironmentSampler& sky, double F) {
  const double ti = std::acos(glm::dot(N, V)), tt = std::asin(std::sin(ti) / ior);
  const glm::dvec3 along = -V, side = glm::normalize(-N + glm::dot(N, V) * V);
  glm::dvec3 sum(0);
  for (int k = 0; k < 12; ++k) {
    const double turn = 2 * (ti - tt) + k * (pi - 2 * tt);
    sum += (1 - F) * std::pow(F, k) * sky.evaluate(std::cos(turn) * along + std::sin(turn) * side).radiance;
  }
  return sum;
}

TEST_F(BodyTest, SmoothBallBendsLightAsSnellSays) {
  const scenes::Scene scene = ball();
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(2.0 + d); }));
  for (const double offset : {0.05, 0.3, 0.6, 0.85}) {
    const glm::dvec3 direction = glm::normalize(glm::dvec3(0.3, -0.2, 1));
    const glm::dvec3 side = glm::normalize(glm::cross(direction, glm::dvec3(0.2, 1, 0.4)));
    SurfaceSample sample = surfaceOf(bodies, -5.0 * direction + offset * side, direction, 0);
    const double NoV = glm::dot(glm::dvec3(sample.normal), glm::dvec3(sample.view));
    const double within = std::sqrt(1 - (1 - NoV * NoV) / 2.25);
    const Integral light = through(sample, bodies, &sky);
    const glm::dvec3 expected =
        ballLight(glm::dvec3(sample.view), glm::dvec3(sample.normal), 1.5, sky, reflectance(1 / 1.5, within));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.specular[c], expected[c], 8e-3) << offset << ", channel " << c;
  }
}

// Each channel with its own index: (n - 1) 0.025 dispersion to either side.
TEST_F(BodyTest, DispersionBendsBlueMoreThanRed) {
  const scenes::Scene scene = ball();
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(1 + d.x); }));
  const glm::dvec3 direction(0, 0, 1);
  SurfaceSample sample = surfaceOf(bodies, {0.7, 0, -5}, direction, 0);
  sample.dispersion = 4;
  const Integral light = through(sample, bodies, &sky);
  for (int c = 0; c < 3; ++c) {
    const double ior = 1.5 + (c - 1) * 0.5 * 0.025 * 4;
    const double NoV = glm::dot(glm::dvec3(sample.normal), glm::dvec3(sample.view));
    const double F = reflectance(1 / ior, std::sqrt(1 - (1 - NoV * NoV) / (ior * ior)));
    EXPECT_NEAR(light.specular[c], ballLight({0, 0, -1}, glm::dvec3(sample.normal), ior, sky, F)[c], 6e-3) << c;
  }
  EXPECT_GT(light.specular.x - light.specular.z, 0.04) << "to the left, the more the bluer";
}

// A rough slab, by a path tracer that is written out here: it draws directions alone, and decides by chance.
TEST_F(BodyTest, RoughSlabIsWhatAPlainPathTracerMakesOfIt) {
  const scenes::Scene scene = slab(0.2f);
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.4, -0.9, 0.2));
  const EnvironmentSampler sky(tests::makePanorama([&](const glm::dvec3& d) {
    return glm::dot(d, sun) > std::cos(0.12) ? glm::vec3(60, 40, 20) : glm::vec3(0.5 + 0.3 * d);
  }));
  constexpr double kIor = 1.5;
  // At a grazing view it matters by which microfacets light enters.
  for (const auto& [roughness, NoV] :
       {std::pair(0.2f, 0.6), std::pair(0.5f, 0.6), std::pair(1.f, 0.6), std::pair(0.6f, 0.05)}) {
    SurfaceSample sample = pane(NoV, roughness);
    sample.thickness = 1;
    sample.absorption = {0, 0.5f, 1};
    const double alpha = double(roughness) * double(roughness);
    std::mt19937_64 random(1);
    std::uniform_real_distribution<double> uniform;
    constexpr int kCount = 400000;
    glm::dvec3 sum(0), squares(0);
    double weights = 0;
    const auto visible = [&](const glm::dvec3& v) { // with y up
      const glm::dvec3 h = sampleVisibleNormal(alpha, {v.x, v.z, v.y}, {uniform(random), uniform(random)});
      return glm::dvec3(h.x, h.z, h.y);
    };
    for (int i = 0; i < kCount; ++i) {
      const glm::dvec3 view = glm::normalize(glm::dvec3(sample.view)), h = visible(view);
      const double weight = 1 - schlick(glm::dot(view, h));
      weights += weight;
      glm::dvec3 ray = glm::refract(-view, h, 1 / kIor), kept(weight);
      for (double up = -1;; up = ray.y > 0 ? 1 : -1) { // the side that the ray comes to
        for (int c = 0; c < 3; ++c) kept[c] *= std::exp(-sample.absorption[c] * 0.2 / std::abs(ray.y));
        const glm::dvec3 v(-ray.x, std::abs(ray.y), -ray.z), m = visible(v);
        if (uniform(random) < reflectance(1 / kIor, glm::dot(v, m))) {
          ray = glm::reflect(-v, m);
          ray.y = -up * std::abs(ray.y);
          continue;
        }
        ray = glm::refract(-v, m, kIor);
        ray.y = up * std::abs(ray.y);
        break;
      }
      const glm::dvec3 light = kept * sky.evaluate(ray).radiance;
      sum += light;
      squares += light * light;
    }
    const glm::dvec3 mean = sum / weights;
    const Integral light = through(sample, bodies, &sky, nullptr, {.relativeError = 2e-3, .maxSamples = 1 << 17});
    for (int c = 0; c < 3; ++c) {
      const double error = std::sqrt((squares[c] / kCount - std::pow(sum[c] / kCount, 2)) / kCount);
      EXPECT_NEAR(light.specular[c], mean[c], 5 * std::hypot(error, light.standardError[c]) + 1e-3 * mean[c])
          << roughness << ", channel " << c << ", errors " << error << " and " << light.standardError[c];
    }
  }
}

// z^2 of 30 degrees of freedom averages 1.07.
TEST_F(BodyTest, ErrorsAreAsLargeAsTheySay) {
  const scenes::Scene scene = ball(96);
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  double sum = 0, worst = 0;
  constexpr int kPoints = 60;
  for (std::uint32_t i = 0; i < kPoints; ++i) {
    SurfaceSample sample = surfaceOf(bodies, {0.012 * i, 0.3, -5}, {0, 0, 1}, 0.1f + 0.015f * static_cast<float>(i));
    sample.pixel = i;
    const auto at = [&](std::uint32_t seed, int count) {
      return through(sample, bodies, &sunny(), nullptr,
                     {.relativeError = 0, .minSamples = count, .maxSamples = count, .seed = seed});
    };
    const Integral a = at(1, 1024), b = at(2, 1024);
    const double z = (a.specular.y - b.specular.y) / std::hypot(a.standardError.y, b.standardError.y);
    sum += z * z;
    worst = std::max(worst, std::abs(z));
    const Integral stopped =
        through(sample, bodies, &sunny(), nullptr, {.relativeError = 0.02, .maxSamples = 1 << 16, .seed = 3});
    EXPECT_LE(largest(stopped.standardError), 0.02 * largest(stopped.specular)) << i;
  }
  EXPECT_TRUE(sum / kPoints > 0.5 && sum / kPoints < 1.7) << sum / kPoints;
  EXPECT_LT(worst, 5.5);
}

// A lamp within the body, one behind it, and one on the side of the eye.
TEST_F(BodyTest, OpaqueSurfacesWithinAndBehindAreSeen) {
  for (const float z : {0.f, 4.f, -3.f}) {
    scenes::Scene scene = ball(192);
    scenes::Material lamp = tests::matte("lamp", 0, 2);
    lamp.specular = 0;
    tests::addObject(scene, scenes::makeBox({-0.4, -0.4, z - 0.1}, {0.4, 0.4, z + 0.1}), lamp);
    const SeenThrough rays(scene);
    Inputs inputs = inputsOf(&white());
    rays.giveTo(inputs);
    SurfaceSample sample = surfaceOf(rays.bodies(), {0, 0, -2}, {0, 0, 1}, 0);
    sample.absorption = glm::vec3(0.5f);
    const glm::dvec3 seen = PassedThroughTest::through(shadeOne(sample, inputs)) / 0.96;
    // Straight through: 2 at most, 1 of the sky; what is reflected at the far side sees the lamp before the ball.
    const double F = 0.04, K = std::exp(-0.5), once = z < 0 ? 2 : 1;
    double expected = 2 * std::exp(-0.5 * 0.9);
    if (z != 0) {
      expected = 0;
      for (int k = 0; k < 8; ++k)
        expected += (1 - F) * std::pow(F, k) * std::pow(K * K, k + 1) * (k % 2 == 1 ? once : z > 0 ? 2 : 1);
    }
    EXPECT_NEAR(seen.x, expected, 2e-3) << z;
  }
}

// One body does not hide another, nor stop its rays.
TEST_F(BodyTest, OtherBodiesArePassedOver) {
  const glm::dvec3 A(1, 2, 3), B(3, 2, 1);
  const EnvironmentSampler sky(tests::makePanorama([&](const glm::dvec3& d) { return glm::vec3(d.y < 0 ? A : B); }));
  scenes::Scene alone = slab(0.5f), crossed = alone;
  tests::addObject(crossed, scenes::makeSphere(0.2, 32, 16), glass(),
                   glm::translate(glm::mat4(1.f), glm::vec3(0, -0.3f, 0)));
  const SeenThrough one(alone), two(crossed);
  SurfaceSample sample = pane(0.8, 0);
  sample.thickness = 1;
  sample.absorption = glm::vec3(1);
  Inputs inputs = inputsOf(&sky);
  one.giveTo(inputs);
  const ShadedSample expected = shadeOne(sample, inputs);
  two.giveTo(inputs);
  EXPECT_EQ(shadeOne(sample, inputs).terms, expected.terms);
}

// A sheet is no body: what goes in does not come out.
TEST_F(BodyTest, ThroughAnOpenMeshLightLeavesAtOnce) {
  scenes::Scene scene;
  tests::addObject(scene, tests::square(1), glass());
  const lighting::Visibility bodies(scene, lighting::Visibility::Contents::bodies);
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(2.0 + d); }));
  SurfaceSample sample = pane(0.5, 0);
  sample.thickness = 1;
  sample.absorption = glm::vec3(1);
  const Integral light = through(sample, bodies, &sky);
  const glm::dvec3 refracted = glm::refract(-glm::dvec3(sample.view), glm::dvec3(0, 1, 0), 1 / 1.5);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(light.specular[c], 2 + refracted[c], 6e-3);
}

// Lights do not shine through bodies.
TEST_F(BodyTest, SunsDoNotShineThrough) {
  const scenes::Scene scene = slab(0.5f);
  const SeenThrough rays(scene);
  Inputs inputs = inputsOf(nullptr, {sunFrom({-0.6f, -0.8f, 0})});
  rays.giveTo(inputs);
  SurfaceSample sample = pane(0.8, 0.3f);
  sample.thickness = 1;
  EXPECT_EQ(PassedThroughTest::through(shadeOne(sample, inputs)), glm::dvec3(0));
  sample.thickness = 0;
  EXPECT_GT(PassedThroughTest::through(shadeOne(sample, inputs)).x, 1);
}

TEST_F(BodyTest, DoesNotDependOnThreadsOrNeighbours) {
  scenes::Scene scene = ball(64);
  tests::addObject(scene, tests::square(3), tests::matte("floor", 0.8f),
                   glm::translate(glm::mat4(1.f), glm::vec3(0, -1, 0)));
  const SeenThrough rays(scene);
  Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 1, 0.2f})});
  rays.giveShadowsTo(inputs);
  std::vector<SurfaceSample> samples;
  for (std::uint32_t i = 0; i < 40; ++i) {
    samples.push_back(surfaceOf(rays.bodies(), {0.02 * i, 0.1, -5}, {0, 0, 1}, 0.05f * static_cast<float>(i % 8)));
    samples.back().pixel = i;
    samples.back().thickness = i % 3 == 0 ? 0 : 1;
    samples.back().dispersion = i % 5 == 0 ? 1 : 0;
    samples.back().diffuseTransmission = i % 2 == 0 ? 0.5f : 0;
    samples.back().transmission = i % 7 == 0 ? 0.5f : 1;
  }
  const Options options{.model = {}, .integral = {.relativeError = 0.02, .maxSamples = 1024}};
  const auto all = shade(samples, inputs, options);
  for (const int threads : {1, 3}) {
    const base::ThreadLimit limit(threads);
    const auto again = shade(samples, inputs, options);
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(again[i].terms, all[i].terms) << i;
  }
  EXPECT_EQ(shade({&samples[17], 1}, inputs, options).front().terms, all[17].terms);
}

} // namespace
} // namespace parity::reference
