// Light through thin walls: the mirrored lobe against sums over a panorama, and what lies behind.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "reference/passed_through.h"
#include "shading/quadrature.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

class ThinWallTest : public PassedThroughTest {
protected:
  // The lobe mirrored at the surface, per unit of radiance and steradian, of light from below: D G2 / (4 N.V), and E
  // that it is over.
  static double mirroredLobe(const glm::dvec3& N, const glm::dvec3& V, const glm::dvec3& L, double roughness) {
    const glm::dvec3 image = L - 2 * glm::dot(N, L) * N;
    const double NoL = glm::dot(N, image), NoV = glm::dot(N, V), alpha = roughness * roughness;
    if (!(NoL > 0)) return 0;
    return tests::distribution(alpha, glm::dot(N, glm::normalize(V + image))) *
           tests::maskingShadowing(tests::Geometry::heightCorrelated, alpha, NoV, NoL) / (4 * NoV);
  }
  static double mirroredAlbedo(double roughness, double NoV) {
    const auto E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, roughness, NoV);
    return E.A + E.B;
  }
  // What the base's specular lobe leaves, of F0 .04.
  static double left(double roughness, double NoV) {
    const auto E = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, roughness, NoV);
    const double average = albedo().row(roughness).average(), Favg = 0.04 + 0.96 / 21;
    const double Fms = Favg * Favg * average / (1 - Favg * (1 - average));
    return 1 - (0.04 * E.A + E.B) - Fms * (1 - E.A - E.B);
  }
};

TEST_F(ThinWallTest, SmoothWallShowsWhatLiesStraightBehind) {
  const scenes::Environment environment = tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(2.0 + d); });
  const EnvironmentSampler sky(environment);
  for (const double NoV : {0.99, 0.7, 0.2})
    for (const glm::vec3& normal : {glm::vec3(0, 1, 0), glm::normalize(glm::vec3(0.3f, 1, -0.2f))}) {
      SurfaceSample sample = pane(NoV, 0);
      const float turn = 0.37f; // not along the rim of a row or a column
      sample.view = glm::vec3(std::cos(turn) * sample.view.x, sample.view.y, std::sin(turn) * sample.view.x);
      sample.normal = normal;
      sample.baseColor = {0.9f, 0.5f, 0.25f};
      sample.transmission = 0.75f;
      sample.occlusion = 0.5f;
      const ShadedSample shaded = shadeOne(sample, inputsOf(&sky));
      EXPECT_EQ(shaded.standardError, 0);
      const double D = 1 - schlick(glm::dot(glm::dvec3(normal), glm::dvec3(sample.view)));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(through(shaded)[c], 0.5 * 0.75 * D * sample.baseColor[c] * (2 - sample.view[c]), 4e-3) << NoV;
      // The cell itself, not one beside it.
      const EnvironmentSample straight = sky.evaluate(-glm::normalize(glm::dvec3(sample.view)));
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(through(shaded)[c], 0.5 * 0.75 * D * sample.baseColor[c] * straight.radiance[c], 1e-6);
    }
}

TEST_F(ThinWallTest, RoughWallHasTheMirroredLobe) {
  const glm::dvec3 sun = glm::normalize(glm::dvec3(-0.7, -0.7, 0.2));
  const scenes::Environment environment = tests::makePanorama([&](const glm::dvec3& d) {
    return glm::dot(d, sun) > std::cos(0.03) ? glm::vec3(900, 700, 400) : glm::vec3(0.5 + 0.3 * d);
  });
  const EnvironmentSampler sky(environment);
  for (const float roughness : {0.25f, 0.6f}) {
    const SurfaceSample sample = pane(0.6, roughness);
    const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view));
    glm::dvec3 sum(0);
    for (int y = tests::kPanoramaHeight / 2; y < tests::kPanoramaHeight; ++y)
      for (int x = 0; x < tests::kPanoramaWidth; ++x) {
        const float* radiance = environment.radiance.at(x, y);
        const double top = pi * y / tests::kPanoramaHeight, step = pi / tests::kPanoramaHeight;
        const double area = (std::cos(top) - std::cos(top + step)) * 2 * pi / tests::kPanoramaWidth;
        sum += area * mirroredLobe(N, V, tests::cellDirection(x, y), roughness) *
               glm::dvec3(radiance[0], radiance[1], radiance[2]);
      }
    const ShadedSample shaded =
        shadeOne(sample, inputsOf(&sky), {.relativeError = 2e-4, .minSamples = 1024, .maxSamples = 1 << 16});
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(through(shaded)[c], left(roughness, 0.6) / mirroredAlbedo(roughness, 0.6) * sum[c],
                  5 * shaded.standardError + 2e-3 * sum[c])
          << roughness;
  }
}

TEST_F(ThinWallTest, LightsShineThrough) {
  SurfaceSample sample = pane(0.6, 0.4f);
  sample.baseColor = {0.9f, 0.5f, 0.25f};
  sample.metallic = 0.25f;
  sample.diffuseTransmission = 0.5f;
  const scenes::Light behind = sunFrom({-0.5f, -0.8f, 0.3f}), before = sunFrom({-0.5f, 0.8f, 0.3f});
  const glm::dvec3 N(sample.normal), V = glm::normalize(glm::dvec3(sample.view)), L = -glm::dvec3(behind.direction);
  const ShadedSample shaded = shadeOne(sample, inputsOf(nullptr, {behind}));
  // Of the base that is metal for a quarter, what is left is that of its F0.
  SurfaceSample bare = sample;
  bare.transmission = bare.diffuseTransmission = 0;
  const Lobes lobes(bare, Model{}, bare.roughness, &albedo());
  const glm::dvec3 D = lobes.viewAt(0.6).diffuse;
  const double lobe = mirroredLobe(N, V, L, sample.roughness) / mirroredAlbedo(sample.roughness, 0.6);
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(through(shaded)[c], 0.75 * D[c] * sample.baseColor[c] * lobe * behind.color[c], 1e-5);
  EXPECT_EQ(layerTerm(shaded, Term::sunDiffuse), glm::dvec3(0));
  EXPECT_EQ(through(shadeOne(sample, inputsOf(nullptr, {before}))), glm::dvec3(0));
  EXPECT_GT(layerTerm(shadeOne(sample, inputsOf(nullptr, {before})), Term::sunSpecular).x, 0);
}

// The other layers are as they were, but for the diffuse lobe's share.
TEST_F(ThinWallTest, TheBaseKeepsWhatDoesNotPass) {
  SurfaceSample sample = layered();
  const Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 0.8f, 0.4f})});
  const IntegralOptions exact{.relativeError = 3e-4, .minSamples = 1024, .maxSamples = 1 << 16};
  const ShadedSample opaque = shadeOne(sample, inputs, exact);
  sample.transmission = 0.5f;
  sample.diffuseTransmission = 0.25f;
  const ShadedSample clear = shadeOne(sample, inputs, exact);
  for (const Term term : {Term::sunSpecular, Term::skySpecular, Term::coatSpecular, Term::sheen, Term::emissive})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(layerTerm(clear, term)[c], layerTerm(opaque, term)[c],
                  5 * (clear.standardError + opaque.standardError));
  for (const Term term : {Term::sunDiffuse, Term::skyDiffuse})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(layerTerm(clear, term)[c], 0.375 * layerTerm(opaque, term)[c], 1e-5) << "(1 - .5) (1 - .25)";
}

// A studio of opaque things: what is seen through the pane is what the reference shows there without the pane.
TEST_F(ThinWallTest, OpaqueSurfacesBehindAreSeenAsTheReferenceShowsThem) {
  scenes::Scene scene;
  scenes::Material floor = tests::matte("floor", 0.8f, 0.3f);
  floor.baseColor = {0.8f, 0.5f, 0.3f, 1};
  floor.roughness = 0.4f;
  tests::addObject(scene, tests::square(3), floor);
  tests::addObject(scene, scenes::makeSphere(0.5, 48, 24), tests::matte("ball", 0.9f),
                   glm::translate(glm::mat4(1.f), glm::vec3(0.6f, 0.5f, 0)));
  const SeenThrough rays(scene);
  for (const bool hasShadows : {false, true}) {
    Inputs inputs = inputsOf(&sunny(), {sunFrom({0.5f, 1, -0.3f}), tests::pointLight({0.5f, 1, -1}, glm::vec3(2))});
    if (hasShadows)
      rays.giveShadowsTo(inputs);
    else
      rays.giveTo(inputs);
    for (const glm::vec3& seen : {glm::vec3(0.1f, 0, 0.1f), glm::vec3(-1, 0, 0.5f)}) {
      SurfaceSample wall = pane(1, 0);
      wall.position = {-0.2f, 1.2f, 0.3f};
      wall.view = glm::normalize(wall.position - seen);
      SurfaceSample there = tests::makePoint(1, 0.4f, 0);
      there.geometricNormal = there.normal;
      there.position = seen;
      there.view = wall.view;
      there.baseColor = {0.8f, 0.5f, 0.3f};
      there.emissive = glm::vec3(0.3f);
      const IntegralOptions many{.relativeError = 0, .minSamples = 1 << 15, .maxSamples = 1 << 15};
      const ShadedSample shown = shadeOne(there, inputs, many), shaded = shadeOne(wall, inputs, many);
      const double D = 1 - schlick(wall.view.y);
      for (int c = 0; c < 3; ++c)
        EXPECT_NEAR(through(shaded)[c], D * sumOfTerms(shown)[c], 5 * (shaded.standardError + shown.standardError))
            << hasShadows << ", " << seen.x;
      EXPECT_LT(shaded.relativeError, 0.01);
    }
  }
}

// The other layers go on without visibility where nothing casts shadows.
TEST_F(ThinWallTest, WithoutShadowsNothingElseIsHidden) {
  scenes::Scene scene;
  tests::addObject(scene, tests::insideOfBox(2), tests::matte("walls", 0, 1));
  const SeenThrough rays(scene);
  SurfaceSample sample = layered();
  sample.geometricNormal = sample.normal;
  sample.transmission = 0.5f;
  sample.diffuseTransmission = 0.5f;
  Inputs inputs = inputsOf(&sunny(), {sunFrom({0.3f, 0.8f, 0.4f})});
  const ShadedSample open = shadeOne(sample, inputs, {.relativeError = 1e-3});
  rays.giveTo(inputs);
  const ShadedSample enclosed = shadeOne(sample, inputs, {.relativeError = 1e-3});
  for (std::size_t t = 0; t < static_cast<std::size_t>(Term::transmission); ++t)
    EXPECT_EQ(open.terms[t], enclosed.terms[t]) << t;
  EXPECT_NE(open.terms.back(), enclosed.terms.back());
}

// In a box of glowing walls, and under a white sky, with everything else that a surface may have.
TEST_F(ThinWallTest, WhiteFurnaceStaysWhite) {
  scenes::Scene box;
  scenes::Material walls = tests::matte("walls", 0, 1);
  walls.specular = 0;
  tests::addObject(box, tests::insideOfBox(2), walls);
  const SeenThrough rays(box);
  Inputs glowing = inputsOf(nullptr);
  rays.giveShadowsTo(glowing);
  double worst = 0;
  for (const float roughness : {0.f, 0.2f, 0.6f, 1.f})
    for (const int layers : {0, 1, 2, 3, 4, 8, 15})
      for (const double NoV : {0.15, 0.7})
        for (const glm::vec2& shares : {glm::vec2(1, 0), glm::vec2(0.5f, 0.5f), glm::vec2(0, 1)}) {
          SurfaceSample sample = pane(NoV, roughness);
          sample.transmission = shares.x;
          sample.diffuseTransmission = shares.y;
          if ((layers & 1) != 0) sample.coat = 0.8f, sample.coatRoughness = 0.2f;
          if ((layers & 2) != 0) sample.sheenColor = glm::vec3(0.6f), sample.sheenRoughness = 0.4f;
          if ((layers & 4) != 0) sample.iridescence = 1, sample.filmThickness = 450;
          if ((layers & 8) != 0) sample.anisotropy = 0.6f, sample.tangent = {0.8f, 0, 0.6f};
          const IntegralOptions integral{.relativeError = 1e-3, .minSamples = 256, .maxSamples = 1 << 14};
          const ShadedSample sky = shadeOne(sample, inputsOf(&white()), integral);
          const ShadedSample seen =
              shade({&sample, 1}, glowing, {.model = {}, .integral = integral, .bounces = 1}).front();
          for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(sumOfTerms(sky)[c], 1, 2e-3 + 5 * sky.standardError)
                << roughness << ", layers " << layers << ", " << NoV << ", " << shares.x;
            EXPECT_NEAR(sumOfTerms(seen)[c], 1, 2e-3 + 5 * seen.standardError)
                << roughness << ", layers " << layers << ", " << NoV << ", " << shares.x;
            worst = std::max(worst, std::abs(sumOfTerms(sky)[c] - 1));
          }
          EXPECT_LT(seen.standardError, 5e-3);
        }
  EXPECT_LT(worst, 0.01);
  std::printf("thin walls in a white furnace: %.1e off at worst\n", worst);
}

// Of a panorama a + b.d the irradiance about a normal is pi a + 2/3 pi b.N: here about -N.
TEST_F(ThinWallTest, DiffuseLightFromBehindIsItsIrradiance) {
  const glm::dvec3 b(0.2, 0.6, -0.3);
  const EnvironmentSampler sky(tests::makePanorama([&](const glm::dvec3& d) { return glm::vec3(1 + glm::dot(b, d)); }));
  SurfaceSample sample = pane(0.6, 0.5f);
  sample.normal = glm::normalize(glm::vec3(0.2f, 1, 0.1f));
  sample.transmission = 0.25f;
  sample.diffuseTransmission = 0.6f;
  sample.diffuseTransmissionColor = {0.9f, 0.5f, 0.2f};
  sample.absorption = {1, 2, 4};
  sample.occlusion = 0.5f;
  const double NoV = glm::dot(glm::dvec3(sample.normal), glm::normalize(glm::dvec3(sample.view)));
  const double D = left(0.5, NoV), behind = 1 - 2.0 / 3 * glm::dot(b, glm::dvec3(sample.normal));
  for (const float thickness : {0.f, 0.5f}) {
    SurfaceSample diffuse = sample;
    diffuse.thickness = thickness;
    diffuse.transmission = 0;
    const ShadedSample shaded = shadeOne(diffuse, inputsOf(&sky));
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(through(shaded)[c],
                  0.5 * D * 0.6 * sample.diffuseTransmissionColor[c] * std::exp(-sample.absorption[c] * thickness) *
                      behind,
                  1e-3)
          << thickness;
  }
  // The rest goes to the thin wall.
  const auto layers = layersOf(sample, {}, {&albedo(), nullptr});
  ASSERT_EQ(layers.size(), 3u);
  EXPECT_EQ(layers[1].kind, LayerKind::thinWall);
  EXPECT_EQ(layers[2].kind, LayerKind::diffuseBehind);
  EXPECT_NEAR(layers[2].weight.y, 0.75 * 0.6 * 0.5 * D, 1e-3);
  // A sun behind, by Lambert.
  sample.transmission = 0;
  const scenes::Light sun = sunFrom({-0.5f, -0.8f, 0.3f});
  const double NoL = glm::dot(glm::dvec3(sample.normal), glm::dvec3(sun.direction));
  const ShadedSample lit = shadeOne(sample, inputsOf(nullptr, {sun}));
  for (int c = 0; c < 3; ++c)
    EXPECT_NEAR(through(lit)[c], D * 0.6 * sample.diffuseTransmissionColor[c] * NoL / pi * sun.color[c], 1e-3);
}

// A closed body casts shadows, but not on light that comes through it.
TEST_F(ThinWallTest, ABodyDoesNotHideTheLightBehindItFromItself) {
  scenes::Scene scene;
  scenes::Material wax = tests::matte("wax", 1);
  wax.diffuseTransmission = 1;
  wax.thickness = 1;
  tests::addObject(scene, scenes::makeSphere(0.5, 64, 32), wax);
  tests::addObject(scene, tests::square(50), tests::matte("floor", 0),
                   glm::translate(glm::mat4(1.f), glm::vec3(0, -1, 0)));
  const SeenThrough rays(scene);
  Inputs inputs = inputsOf(&white(), {sunFrom({-1, 0.1f, 0}), sunFrom({-1, -0.1f, 0})});
  rays.giveShadowsTo(inputs);
  SurfaceSample sample;
  sample.position = {0.5f, 0, 0};
  sample.normal = sample.geometricNormal = {1, 0, 0};
  sample.view = {1, 0, 0};
  sample.dielectricF0 = glm::vec3(0);
  sample.dielectricF90 = 0;
  sample.diffuseTransmission = 1;
  sample.thickness = 1;
  const ShadedSample shaded = shadeOne(sample, inputs, {.relativeError = 2e-3});
  // Half of the sky is hidden by the black floor, which reflects 4 %, and one sun is below it.
  inputs.environment = nullptr;
  const double sun = 3 / pi / std::hypot(1, 0.1);
  EXPECT_NEAR(through(shadeOne(sample, inputs, {.relativeError = 2e-3})).x, sun, 0.02);
  EXPECT_NEAR(through(shaded).x, sun + 0.5, 0.05);
  sample.thickness = 0; // a leaf of this shape does
  EXPECT_NEAR(through(shadeOne(sample, inputs, {.relativeError = 2e-3})).x, 0, 0.05);
}

} // namespace
} // namespace parity::reference
