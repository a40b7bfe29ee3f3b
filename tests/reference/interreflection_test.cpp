// Light between surfaces: closed rooms whose series are known, mirrors that show what the reference shows there.
#include "reference/interreflection.h"

#include <numbers>

#include <gtest/gtest.h>

#include "base/parallel.h"
#include "reference/shade.h"
#include "reference/surroundings.h"
#include "shading/shading.h"
#include "support/matte_scenes.h"

namespace parity::reference {
namespace {

using shading::Term;
using tests::addObject;

using std::numbers::pi;

// A Lambertian without any specular light.
scenes::Material lambert(const std::string& name, float albedo, float emitted = 0) {
  scenes::Material material = tests::matte(name, albedo, emitted);
  material.specular = 0;
  return material;
}

SurfaceSample lambertPoint(const glm::vec3& position, const glm::vec3& normal, float albedo) {
  SurfaceSample sample;
  sample.position = position;
  sample.normal = sample.geometricNormal = normal;
  sample.view = glm::normalize(normal + glm::vec3(0.3f, 0.1f, 0.2f));
  sample.baseColor = glm::vec3(albedo);
  sample.dielectricF0 = glm::vec3(0);
  sample.dielectricF90 = 0;
  return sample;
}

// A scene with all that rays need of it.
class Rays {
public:
  explicit Rays(const scenes::Scene& scene) : m_visibility(scene), m_surfaces(scene), m_emitters(scene, m_surfaces) {}
  Inputs inputs(const EnvironmentSampler* sky = nullptr, std::vector<scenes::Light> lights = {},
                const DirectionalAlbedo* albedo = nullptr) const {
    return {sky, albedo, std::move(lights), &m_visibility, &m_surfaces, &m_emitters};
  }
  const lighting::Visibility& visibility() const { return m_visibility; }

private:
  lighting::Visibility m_visibility;
  lighting::SurfaceLight m_surfaces;
  lighting::Emitters m_emitters;
};

Options options(int bounces, int samples, const Model& model = tests::plainModel(), std::uint32_t seed = 0) {
  return {model, {.relativeError = 0, .minSamples = samples, .maxSamples = samples, .seed = seed}, bounces};
}

glm::dvec3 termOf(const ShadedSample& shaded, Term t) { return shaded.terms[static_cast<std::size_t>(t)]; }
glm::dvec3 colorOf(const ShadedSample& shaded) {
  glm::dvec3 sum(0);
  for (const glm::vec3& term : shaded.terms) sum += term;
  return sum;
}

ShadedSample shadeOne(const SurfaceSample& sample, const Inputs& inputs, const Options& options) {
  return shade(std::span(&sample, 1), inputs, options)[0];
}

// In a closed box of albedo rho and emitted radiance 1 every direction shows the same: sum of rho^k, k = 0 .. N.
TEST(Interreflection, ClosedBoxOfGlowingWallsIsAGeometricSeries) {
  for (const float albedo : {0.2f, 0.8f}) {
    scenes::Scene scene;
    addObject(scene, tests::insideOfBox(1), lambert("walls", albedo, 1));
    const Rays rays(scene);
    SurfaceSample sample = lambertPoint({0.3f, -1, -0.6f}, {0, 1, 0}, albedo);
    sample.emissive = glm::vec3(1);
    for (const int bounces : {0, 1, 2, 5}) {
      const ShadedSample shaded = shadeOne(sample, rays.inputs(), options(bounces, 1 << 12));
      const double series = (1 - std::pow(albedo, bounces + 1)) / (1 - albedo);
      EXPECT_NEAR(colorOf(shaded).x, series, 5 * shaded.standardError + 1e-6) << albedo << ", " << bounces;
      EXPECT_LT(shaded.standardError, 0.01 * series);
    }
  }
}

// The same of all materials that lose nothing, whatever their lobes: 1 + N.
TEST(Interreflection, ClosedBoxOfWhiteSurfacesKeepsAllItsLight) {
  const Model model; // balanced, with light between microfacets
  const DirectionalAlbedo albedo(model.surface.geometryTerm, model.surface.fresnel);
  for (const float metallic : {0.f, 1.f})
    for (const float roughness : {0.f, 0.2f, 0.7f}) {
      scenes::Scene scene;
      scenes::Material walls = tests::matte("walls", 1, 1);
      walls.metallic = metallic;
      walls.roughness = roughness;
      addObject(scene, tests::insideOfBox(1), walls);
      const Rays rays(scene);
      SurfaceSample sample = lambertPoint({0.2f, -1, 0.4f}, {0, 1, 0}, 1);
      sample.metallic = metallic;
      sample.roughness = roughness;
      sample.dielectricF0 = glm::vec3(0.04f);
      sample.dielectricF90 = 1;
      sample.emissive = glm::vec3(1);
      for (const int bounces : {1, 3}) {
        const ShadedSample shaded =
            shadeOne(sample, rays.inputs(nullptr, {}, &albedo), options(bounces, 1 << 14, model));
        EXPECT_NEAR(colorOf(shaded).x, 1 + bounces, 5 * shaded.standardError + 1e-4)
            << metallic << ", " << roughness << ", " << bounces;
        EXPECT_LT(shaded.standardError, 0.03 * bounces);
      }
    }
}

// An integrating sphere of albedo rho with a lamp of I candela at its centre: the wall's direct irradiance is E = I /
// R^2, and what comes by way of the wall is the same everywhere, E rho + ... + E rho^N.
TEST(Interreflection, IntegratingSphereIsLitEvenlyByItsWall) {
  constexpr float kRadius = 2, kAlbedo = 0.7f, kCandela = 8;
  scenes::Scene scene;
  scenes::Material wall = lambert("wall", kAlbedo);
  wall.doubleSided = true;
  addObject(scene, scenes::makeSphere(kRadius, 96, 48), wall);
  const Rays rays(scene);
  const scenes::Light lamp = tests::pointLight({0, 0, 0}, glm::vec3(kCandela));
  const double direct = kCandela / (kRadius * kRadius);
  for (const glm::dvec3 at : {glm::dvec3(0.1, -0.9, 0.3), glm::dvec3(0.8, 0.1, -0.5)}) {
    // On the mesh, which lies a little within the sphere.
    const auto hit = rays.visibility().firstHit(glm::dvec3(0), glm::normalize(at));
    ASSERT_TRUE(hit.has_value());
    SurfaceSample sample = lambertPoint(glm::normalize(at) * double(hit->distance), -glm::normalize(at), kAlbedo);
    sample.geometricNormal = -hit->geometric * (hit->front ? -1.f : 1.f);
    for (const int bounces : {1, 2, 4}) {
      double series = 0;
      for (int k = 1; k <= bounces; ++k) series += std::pow(kAlbedo, k);
      const ShadedSample shaded = shadeOne(sample, rays.inputs(nullptr, {lamp}), options(bounces, 1 << 12));
      EXPECT_NEAR(termOf(shaded, Term::localDiffuse).x, kAlbedo / pi * direct, 0.01 * direct);
      // Facets of 3.75 degrees: within 0.5 %.
      EXPECT_NEAR(termOf(shaded, Term::skyDiffuse).x, kAlbedo / pi * direct * series,
                  0.005 * series + 5 * shaded.standardError)
          << bounces;
    }
  }
}

// Materials of all kinds, textures and lights: a floor and objects about it.
scenes::Scene makeStudio() {
  scenes::Scene scene;
  scenes::TextureImage tiles{"tiles", base::Image8(2, 2, 4, 255)};
  const std::uint8_t colors[4][3] = {{255, 40, 40}, {40, 255, 40}, {40, 40, 255}, {200, 200, 200}};
  for (int i = 0; i < 4; ++i)
    for (int c = 0; c < 3; ++c) tiles.pixels.at(i % 2, i / 2)[c] = colors[i][c];
  scene.images.push_back(tiles);
  scenes::Material floor = tests::matte("floor", 0.8f);
  floor.roughness = 0.4f;
  floor.baseColorTexture.image = 0;
  floor.baseColorTexture.sampler.magFilter = scenes::Filter::nearest;
  addObject(scene, tests::square(3), floor);
  scenes::Material ball = tests::matte("ball", 0.9f);
  ball.metallic = 1;
  ball.roughness = 0.3f;
  addObject(scene, scenes::makeSphere(0.5, 48, 24), ball, glm::translate(glm::mat4(1.f), glm::vec3(0.4f, 0.5f, 0)));
  scenes::Material lamp = tests::matte("lamp", 0, 20);
  lamp.doubleSided = true;
  addObject(scene, tests::square(0.3f), lamp, glm::translate(glm::mat4(1.f), glm::vec3(-1, 1.5f, 0.5f)));
  return scene;
}

// A mirror shows, times Fresnel's reflectance, what the reference shows of the point that it mirrors with one bounce
// less: colour by colour, light by light.
TEST(Interreflection, MirrorShowsWhatTheReferenceShowsThere) {
  scenes::Scene scene = makeStudio();
  const Rays rays(scene);
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  scenes::Light sun;
  sun.kind = scenes::LightKind::directional;
  sun.direction = glm::normalize(glm::vec3(-0.5f, -1, 0.3f));
  sun.color = glm::vec3(3, 2, 1);
  const Inputs inputs = rays.inputs(&sky, {sun, tests::pointLight({-0.5f, 1, -1}, glm::vec3(2))});
  for (const glm::vec3 seen : {glm::vec3(-0.4f, 0, 0.7f), glm::vec3(-0.2f, 0, -0.3f), glm::vec3(1.2f, 0, 0.2f)}) {
    // The mirror at this place, facing half way between floor point and eye.
    SurfaceSample mirror;
    mirror.position = {-1.5f, 0.8f, 1.5f};
    const glm::vec3 towards = glm::normalize(seen - mirror.position);
    mirror.view = glm::normalize(glm::vec3(1, 0.5f, 0.3f));
    mirror.normal = mirror.geometricNormal = glm::normalize(towards + mirror.view);
    mirror.metallic = 1;
    mirror.roughness = 0;
    mirror.baseColor = {0.9f, 0.8f, 0.7f};
    SurfaceSample floor = lambertPoint(seen, {0, 1, 0}, 0);
    floor.view = -towards;
    const glm::dvec2 uv = glm::dvec2(seen.x + 3, seen.z + 3) / 6.0;
    const int tile = (uv.x >= 0.5) + 2 * (uv.y >= 0.5);
    const std::uint8_t* texel = scene.images[0].pixels.pixels.data() + 4 * tile;
    for (int c = 0; c < 3; ++c)
      floor.baseColor[c] = 0.8f * static_cast<float>(shading::f64::srgbToLinear(texel[c] / 255.0));
    floor.roughness = 0.4f;
    floor.dielectricF0 = glm::vec3(0.04f);
    floor.dielectricF90 = 1;
    for (const int bounces : {1, 2, 3}) {
      const ShadedSample there = shadeOne(floor, inputs, options(bounces - 1, 1 << 14));
      const ShadedSample none = shadeOne(mirror, inputs, options(0, 1 << 15));
      const ShadedSample some = shadeOne(mirror, inputs, options(bounces, 1 << 15));
      EXPECT_EQ(termOf(none, Term::skySpecular), glm::dvec3(0)) << "the floor hides the sky";
      const double VoN = glm::dot(mirror.view, mirror.normal);
      for (int c = 0; c < 3; ++c) {
        const double F = mirror.baseColor[c] + (1 - mirror.baseColor[c]) * std::pow(1 - VoN, 5);
        EXPECT_NEAR(termOf(some, Term::skySpecular)[c], F * colorOf(there)[c],
                    5 * (some.standardError + there.standardError))
            << bounces << ", channel " << c << ", at " << seen.x << " " << seen.z;
      }
      EXPECT_LT(some.relativeError, 0.03);
    }
  }
}

// 5 % of the light, by three seeds: what they say of their errors is so.
TEST(Interreflection, ErrorsAreAsLargeAsTheySay) {
  const scenes::Scene scene = makeStudio();
  const Rays rays(scene);
  const EnvironmentSampler sky(tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(1 + d.y); }));
  const Inputs inputs = rays.inputs(&sky);
  std::vector<SurfaceSample> samples;
  for (std::uint32_t i = 0; i < 60; ++i) {
    SurfaceSample sample = lambertPoint({-1.2f + 0.04f * i, 0, 0.6f - 0.02f * i}, {0, 1, 0}, 0.7f);
    sample.dielectricF0 = glm::vec3(0.04f);
    sample.dielectricF90 = 1;
    sample.roughness = 0.1f + 0.015f * i;
    sample.metallic = i % 3 * 0.5f;
    sample.pixel = i;
    samples.push_back(sample);
  }
  const auto run = [&](std::uint32_t seed, int count) {
    return shade(samples, inputs, options(2, count, tests::plainModel(), seed));
  };
  const auto a = run(1, 512), b = run(2, 512);
  double squares = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const glm::dvec3 difference = colorOf(a[i]) - colorOf(b[i]);
    const double z = difference.y / std::hypot(a[i].standardError, b[i].standardError);
    EXPECT_LT(std::abs(z), 5) << i;
    squares += z * z;
  }
  // The errors are of the worst channel, so a channel's z^2 averages a little less than 1.07.
  EXPECT_TRUE(squares / 60 > 0.4 && squares / 60 < 1.6) << squares / 60;
  // And the wanted error is reached, the sky's and the surfaces' together.
  Options wanted = options(2, 256);
  wanted.integral.relativeError = 0.03;
  wanted.integral.maxSamples = 1 << 16;
  for (const ShadedSample& shaded : shade(samples, inputs, wanted)) EXPECT_LE(shaded.relativeError, 0.03f);
}

TEST(Interreflection, NoBouncesAreTheShadowsAlone) {
  const scenes::Scene scene = makeStudio();
  const Rays rays(scene);
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  const SurfaceSample sample = lambertPoint({0.2f, 0, 0.9f}, {0, 1, 0}, 0.7f);
  Inputs shadows;
  shadows.environment = &sky;
  shadows.visibility = &rays.visibility();
  EXPECT_EQ(shadeOne(sample, rays.inputs(&sky), options(0, 1024)).terms,
            shadeOne(sample, shadows, options(0, 1024)).terms);
  EXPECT_GT(colorOf(shadeOne(sample, rays.inputs(&sky), options(1, 1024))).x,
            colorOf(shadeOne(sample, shadows, options(0, 1024))).x);
}

TEST(Interreflection, DoesNotDependOnThreadsOrNeighbours) {
  const scenes::Scene scene = makeStudio();
  const Rays rays(scene);
  const EnvironmentSampler sky(tests::makeSunnyPanorama());
  std::vector<SurfaceSample> samples;
  for (std::uint32_t i = 0; i < 40; ++i) {
    samples.push_back(lambertPoint({-1 + 0.05f * i, 0, 0.4f}, {0, 1, 0}, 0.5f));
    samples.back().pixel = i;
  }
  const auto all = shade(samples, rays.inputs(&sky), options(2, 256));
  for (const int threads : {1, 3}) {
    const base::ThreadLimit limit(threads);
    const auto again = shade(samples, rays.inputs(&sky), options(2, 256));
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_EQ(again[i].terms, all[i].terms) << i;
  }
  EXPECT_EQ(shadeOne(samples[17], rays.inputs(&sky), options(2, 256)).terms, all[17].terms);
}

// The back of what has but one side is black; holes of masks are open; what is blended or unlit is not there.
TEST(Interreflection, OnlySidesAndPartsThatAreSeenSendLight) {
  const auto lightFrom = [](const std::function<void(scenes::Material&)>& change, bool turned) {
    scenes::Scene scene;
    addObject(scene, tests::square(1), lambert("floor", 0.5f));
    scenes::Material panel = lambert("panel", 0, 3);
    change(panel);
    const glm::mat4 above = glm::translate(glm::mat4(1.f), glm::vec3(0, 1, 0));
    addObject(scene, tests::square(1), panel,
              turned ? above : glm::rotate(above, glm::radians(180.f), glm::vec3(1, 0, 0)));
    const Rays rays(scene);
    return termOf(shadeOne(lambertPoint({0, 0, 0}, {0, 1, 0}, 0.5f), rays.inputs(), options(1, 1 << 12)),
                  Term::skyDiffuse)
        .x;
  };
  // Form factor of a square of side 2 at a height of 1, seen from below its centre: four times Howell's B-3 of a = b =
  // 1: 4 / (2 pi) * 2 * (1 / sqrt 2) atan(1 / sqrt 2).
  const double formFactor = 4 / pi / std::sqrt(2.0) * std::atan(1 / std::sqrt(2.0)), full = 0.5 * 3 * formFactor;
  EXPECT_NEAR(lightFrom([](scenes::Material&) {}, false), full, 1e-3);
  EXPECT_EQ(lightFrom([](scenes::Material&) {}, true), 0);
  EXPECT_NEAR(lightFrom([](scenes::Material& m) { m.doubleSided = true; }, true), full, 1e-3);
  EXPECT_EQ(lightFrom([](scenes::Material& m) { m.unlit = true; }, false), 0);
  EXPECT_EQ(lightFrom([](scenes::Material& m) { m.alphaMode = scenes::AlphaMode::blend; }, false), 0);
  EXPECT_EQ(lightFrom(
                [](scenes::Material& m) {
                  m.alphaMode = scenes::AlphaMode::mask;
                  m.baseColor.a = 0.2f;
                },
                false),
            0);
}

} // namespace
} // namespace parity::reference
