// Visibility in the integrals: occluders whose form factors are known, suns and lamps behind something.
#include <numbers>

#include <gtest/gtest.h>

#include "reference/direct_light.h"
#include "reference/environment_integral.h"
#include "reference/sampling.h"
#include "reference/surroundings.h"
#include "scenes/builtin/shapes.h"

namespace parity::reference {
namespace {

using std::numbers::pi;

// Triangles of one opaque material, corners in threes.
scenes::Scene makeOccluder(const std::vector<glm::vec3>& corners) {
  scenes::Scene scene;
  scene.name = "occluder";
  scene.materials.emplace_back();
  scenes::Mesh& mesh = scene.meshes.emplace_back();
  mesh.positions = corners;
  for (std::uint32_t i = 0; i < corners.size(); ++i) mesh.indices.push_back(i);
  scene.instances.push_back({0, glm::mat4(1.f), "occluder"});
  return scene;
}

// From x = distance upright to y = height, as good as endless along z.
scenes::Scene makeWall(float distance, float height) {
  const float far = 1000 * height;
  return makeOccluder({{distance, 0, -far},
                       {distance, height, -far},
                       {distance, 0, far},
                       {distance, 0, far},
                       {distance, height, -far},
                       {distance, height, far}});
}

// Parallel to the floor, its centre above the origin.
scenes::Scene makeDisk(float radius, float height) {
  std::vector<glm::vec3> corners;
  constexpr int kSides = 720;
  const auto rim = [&](int i) {
    return glm::vec3(radius * std::cos(2 * pi * i / kSides), height, radius * std::sin(2 * pi * i / kSides));
  };
  for (int i = 0; i < kSides; ++i) corners.insert(corners.end(), {{0, height, 0}, rim(i), rim(i + 1)});
  return makeOccluder(corners);
}

SurfaceSample makeFloorPoint(float roughness, float metallic) {
  SurfaceSample sample = tests::makePoint(0.8, roughness, metallic);
  sample.geometricNormal = sample.normal;
  sample.baseColor = glm::vec3(1);
  return sample;
}

class ShadowTest : public testing::Test {
protected:
  // What a white Lambertian floor at the origin reflects of a white sky: the share that is not hidden.
  static Integral skyShare(const scenes::Scene& scene, const SurfaceSample& sample) {
    const lighting::Visibility visibility(scene);
    const Lobes lobes(sample, tests::plainModel(), sample.roughness, nullptr);
    const IntegralOptions options{.relativeError = 0, .minSamples = 1 << 15, .maxSamples = 1 << 15, .seed = 0};
    return integrateEnvironment(sample, lobes, white(), glm::dvec3(0), options, PointVisibility(&visibility, sample));
  }
  static const EnvironmentSampler& white() {
    static const EnvironmentSampler sampler(tests::makeWhitePanorama());
    return sampler;
  }
};

// Form factors of a point on the floor, Howell's catalogue: endless upright wall B-4, (1 - d / sqrt(d^2 + h^2)) / 2;
// disk above it B-13, r^2 / (r^2 + h^2).
TEST_F(ShadowTest, IrradianceUnderAWhiteSkyIsOneLessTheOccludersFormFactor) {
  const SurfaceSample floor = makeFloorPoint(0.5f, 0);
  const struct {
    const char* name;
    scenes::Scene scene;
    double formFactor;
  } cases[] = {{"wall at the point", makeWall(1e-3f, 100), 0.5 * (1 - 1e-5)},
               {"wall as far as high", makeWall(2, 2), 0.5 * (1 - std::sqrt(0.5))},
               {"disk", makeDisk(1, 2), 0.2},
               {"disk of half the light", makeDisk(3, 3), 0.5},
               {"nothing", scenes::Scene(), 0}};
  for (const auto& c : cases) {
    const Integral result = skyShare(c.scene, floor);
    EXPECT_NEAR(result.diffuse.x, 1 - c.formFactor, 1e-3) << c.name;
    EXPECT_LT(std::abs(result.diffuse.x - (1 - c.formFactor)), 5 * result.standardError.x + 5e-5) << c.name;
  }
}

TEST_F(ShadowTest, SmoothAndRoughLobesLoseWhatLiesInTheirWay) {
  // The wall fills the side that the view's mirror image looks at.
  for (const float roughness : {0.f, 0.1f}) {
    const SurfaceSample mirror = makeFloorPoint(roughness, 1); // V leans to +X
    EXPECT_LE(skyShare(makeWall(-1e-3f, 100), mirror).specular.x, roughness > 0 ? 1e-3 : 0) << "tails of GGX";
    EXPECT_NEAR(skyShare(makeWall(1e-3f, 100), mirror).specular.x, 1, 0.02) << roughness;
  }
}

scenes::Light makeSun(const glm::vec3& towards) {
  scenes::Light light;
  light.kind = scenes::LightKind::directional;
  light.direction = -glm::normalize(towards);
  return light;
}

DirectLight directLight(const scenes::Scene& scene, const SurfaceSample& sample, const scenes::Light& light) {
  const lighting::Visibility visibility(scene);
  return shadeDirect(sample, {light}, tests::plainModel(), nullptr, PointVisibility(&visibility, sample));
}

TEST_F(ShadowTest, SunIsAllOrNothing) {
  const SurfaceSample floor = makeFloorPoint(0.5f, 0);
  const scenes::Scene wall = makeWall(1, 1); // hides what is lower than 45 degrees towards +X
  for (const float elevation : {0.9f, 1.1f}) {
    const DirectLight light = directLight(wall, floor, makeSun({1, elevation, 0}));
    const DirectLight open = shadeDirect(floor, {makeSun({1, elevation, 0})}, tests::plainModel(), nullptr);
    EXPECT_EQ(light.sunDiffuse, elevation > 1 ? open.sunDiffuse : glm::dvec3(0));
    EXPECT_EQ(light.sunSpecular, elevation > 1 ? open.sunSpecular : glm::dvec3(0));
    EXPECT_GT(open.sunDiffuse.x, 0.1);
  }
  EXPECT_GT(directLight(wall, floor, makeSun({-1, 0.5f, 0})).sunDiffuse.x, 0) << "from the other side";
}

TEST_F(ShadowTest, LampIsHiddenByWhatStandsBeforeItAlone) {
  const SurfaceSample floor = makeFloorPoint(0.5f, 0);
  scenes::Light lamp;
  lamp.position = {0.1f, 2, 0};
  lamp.direction = {0, -1, 0};
  for (const scenes::LightKind kind : {scenes::LightKind::point, scenes::LightKind::spot}) {
    lamp.kind = kind;
    const double open = shadeDirect(floor, {lamp}, tests::plainModel(), nullptr).localDiffuse.x;
    EXPECT_GT(open, 0.01);
    EXPECT_EQ(directLight(makeDisk(1, 1), floor, lamp).localDiffuse.x, 0);
    EXPECT_EQ(directLight(makeDisk(1, 3), floor, lamp).localDiffuse.x, open) << "behind it";
    EXPECT_EQ(directLight(makeDisk(1, 2), floor, lamp).localDiffuse.x, open) << "in the disk's plane";
  }
}

// The shading normal leans to +X, so that it sees a sun that the floor does not.
TEST_F(ShadowTest, WhatIsBelowTheGeometricSurfaceIsHidden) {
  SurfaceSample sample = makeFloorPoint(0.5f, 0);
  sample.normal = glm::normalize(glm::vec3(1, 1, 0));
  const scenes::Light low = makeSun({1, -0.05f, 0}), high = makeSun({1, 0.05f, 0});
  EXPECT_GT(shadeDirect(sample, {low}, tests::plainModel(), nullptr).sunDiffuse.x, 0.1);
  EXPECT_EQ(directLight(scenes::Scene(), sample, low).sunDiffuse.x, 0);
  EXPECT_GT(directLight(scenes::Scene(), sample, high).sunDiffuse.x, 0.1);
  // Of the white sky about a normal of 45 degrees, (1 + cos 45) / 2 lies above the floor.
  EXPECT_NEAR(skyShare(scenes::Scene(), sample).diffuse.x, 0.5 * (1 + std::sqrt(0.5)), 1e-3);
}

// Integral over a sky, with the shadows of a scene and without any.
struct WithAndWithout {
  Integral shadowed, open;
};
WithAndWithout integrateBoth(const scenes::Scene& scene, const SurfaceSample& sample, const EnvironmentSampler& sky) {
  const lighting::Visibility visibility(scene);
  const Lobes lobes(sample, tests::plainModel(), sample.roughness, nullptr);
  const IntegralOptions options{.relativeError = 0, .minSamples = 1 << 14, .maxSamples = 1 << 14, .seed = 0};
  return {integrateEnvironment(sample, lobes, sky, glm::dvec3(0), options, PointVisibility(&visibility, sample)),
          integrateEnvironment(sample, lobes, sky, glm::dvec3(0), options)};
}

scenes::Scene makeGround() {
  return makeOccluder({{-9, 0, -9}, {-9, 0, 9}, {9, 0, -9}, {9, 0, -9}, {-9, 0, 9}, {9, 0, 9}});
}

// A normal map on flat metal: the reflection dips below the ground where the normal leans away from the eye. The lobe
// keeps its energy, so the metal is as bright as without shadows, and it never sees what lies below the ground.
TEST_F(ShadowTest, NormalMappedMetalAloneIsAsBrightAsWithoutShadows) {
  const EnvironmentSampler brightBelow(
      tests::makePanorama([](const glm::dvec3& d) { return glm::vec3(d.y > 0 ? 1 : 5); }));
  int dips = 0;
  for (const float tiltDeg : {-50.f, -25.f, 0.f, 25.f, 50.f})
    for (const float roughness : {0.f, 0.05f, 0.3f, 0.8f})
      for (const double NoV : {0.15, 0.5, 0.9}) {
        SurfaceSample metal = tests::makePoint(NoV, roughness, 1); // V leans to +X
        const float tilt = glm::radians(tiltDeg);
        metal.geometricNormal = metal.normal;
        metal.normal = {std::sin(tilt), std::cos(tilt), 0};
        metal.baseColor = {0.9f, 0.6f, 0.3f};
        const glm::dvec3 V(metal.view), N(metal.normal);
        if (!(glm::dot(N, V) > 0.05)) continue; // turned away from the eye
        dips += (2 * glm::dot(N, V) * N - V).y < 0;
        const auto [shadowed, open] = integrateBoth(makeGround(), metal, white());
        const std::string what = "tilt " + std::to_string(tiltDeg) + ", roughness " + std::to_string(roughness) +
                                 ", NoV " + std::to_string(NoV);
        EXPECT_NEAR(shadowed.specular.x, open.specular.x, 5 * (shadowed.standardError.x + open.standardError.x) + 1e-6)
            << what;
        EXPECT_LT(shadowed.standardError.x, 2e-3) << what;
        const Integral above = integrateBoth(makeGround(), metal, brightBelow).shadowed;
        EXPECT_NEAR(above.specular.x, open.specular.x, 5 * (above.standardError.x + open.standardError.x) + 2e-3)
            << what;
      }
  EXPECT_GE(dips, 8);
}

// The diffuse lobe is not folded: what a normal of 45 degrees sees of the lower half is dark, (1 + cos 45) / 2 is left.
TEST_F(ShadowTest, DiffuseLightFromBelowTheGroundIsHidden) {
  SurfaceSample sample = makeFloorPoint(0.5f, 0);
  sample.normal = glm::normalize(glm::vec3(1, 1, 0));
  EXPECT_NEAR(skyShare(makeGround(), sample).diffuse.x, 0.5 * (1 + std::sqrt(0.5)), 1e-3);
}

// Points all over a coarse sphere with smooth normals, as the camera sees them.
std::vector<SurfaceSample> samplesOf(const scenes::Mesh& mesh, std::uint32_t perTriangle) {
  std::vector<SurfaceSample> samples;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    const std::uint32_t* k = mesh.indices.data() + t;
    const glm::vec3 p[] = {mesh.positions[k[0]], mesh.positions[k[1]], mesh.positions[k[2]]};
    const glm::vec3 geometric = glm::cross(p[1] - p[0], p[2] - p[0]);
    if (glm::length(geometric) < 1e-6f) continue; // at the poles
    for (std::uint32_t i = 0; i < perTriangle; ++i) {
      const glm::dvec2 u = sobolPoint(i, hashCombine(static_cast<std::uint32_t>(t), 7));
      const float root = std::sqrt(float(u.x)), b = root * (1 - float(u.y)), c = root * float(u.y);
      SurfaceSample sample;
      sample.position = (1 - b - c) * p[0] + b * p[1] + c * p[2];
      sample.normal =
          glm::normalize((1 - b - c) * mesh.normals[k[0]] + b * mesh.normals[k[1]] + c * mesh.normals[k[2]]);
      sample.geometricNormal = glm::normalize(geometric);
      sample.view = sample.geometricNormal;
      samples.push_back(sample);
    }
  }
  return samples;
}

// A sphere of 12 x 6 facets in the sun is lit where its normals are: facets that turn away and neighbours that rise
// before a point take no light from it.
TEST_F(ShadowTest, CoarseSmoothSphereHasASmoothTerminator) {
  scenes::Scene scene = makeOccluder({});
  scene.meshes[0] = scenes::makeSphere(1, 12, 6);
  const lighting::Visibility visibility(scene);
  const scenes::Light sun = makeSun({1, 0.3f, 0.2f});
  double open = 0, lost = 0;
  for (const SurfaceSample& sample : samplesOf(scene.meshes[0], 64)) {
    const double all = shadeDirect(sample, {sun}, tests::plainModel(), nullptr).sunDiffuse.x;
    const double lit =
        shadeDirect(sample, {sun}, tests::plainModel(), nullptr, PointVisibility(&visibility, sample)).sunDiffuse.x;
    open += all;
    lost += std::abs(all - lit);
  }
  std::printf("lost to facets: %.3g of the light\n", lost / open);
  EXPECT_LT(lost, 1e-3 * open);
}

// Rays begin above the facet only where nothing lies between it and the smooth surface.
TEST_F(ShadowTest, WhatLiesCloseToAFacetStillHidesTheSky) {
  scenes::Scene scene = makeOccluder({});
  scene.meshes[0] = scenes::makeSphere(1, 12, 6);
  SurfaceSample sample = samplesOf(scene.meshes[0], 1)[40];
  const glm::vec3 n = sample.geometricNormal, t = glm::normalize(glm::cross(n, glm::vec3(0, 1, 0))),
                  b = glm::cross(n, t), c = sample.position + 1e-3f * n;
  sample.normal = n;
  EXPECT_GT(skyShare(scene, sample).diffuse.x, 0.9);
  scenes::Mesh plate;
  plate.positions = {c - 2.f * t - 2.f * b, c + 4.f * t - 2.f * b, c - 2.f * t + 4.f * b};
  plate.indices = {0, 1, 2};
  scene.meshes.push_back(plate);
  scene.instances.push_back({1, glm::mat4(1.f), "plate"});
  EXPECT_LT(skyShare(scene, sample).diffuse.x, 1e-2);
}

} // namespace
} // namespace parity::reference
