// Visibility in the integrals: occluders whose form factors are known, suns and lamps behind something.
#include <gtest/gtest.h>

#include "reference/direct_light.h"
#include "reference/environment_integral.h"
#include "reference/surroundings.h"

namespace parity::reference {
namespace {

constexpr double kPi = std::numbers::pi;

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
    return glm::vec3(radius * std::cos(2 * kPi * i / kSides), height, radius * std::sin(2 * kPi * i / kSides));
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
    return integrateEnvironment(sample, lobes, white(), glm::dvec3(0), options, &visibility);
  }
  static const EnvironmentSampler& white() {
    static const EnvironmentSampler sampler(tests::makeWhitePanorama());
    return sampler;
  }
};

// Form factors of a point on the floor, Howell's catalogue: endless upright wall B-4, (1 - d / sqrt(d^2 + h^2)) / 2;
// disk above it B-13, r^2 / (r^2 + h^2).
TEST_F(ShadowTest, irradianceUnderAWhiteSkyIsOneLessTheOccludersFormFactor) {
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

TEST_F(ShadowTest, smoothAndRoughLobesLoseWhatLiesInTheirWay) {
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
  return shadeDirect(sample, {light}, tests::plainModel(), nullptr, &visibility);
}

TEST_F(ShadowTest, sunIsAllOrNothing) {
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

TEST_F(ShadowTest, lampIsHiddenByWhatStandsBeforeItAlone) {
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
TEST_F(ShadowTest, whatIsBelowTheGeometricSurfaceIsHidden) {
  SurfaceSample sample = makeFloorPoint(0.5f, 0);
  sample.normal = glm::normalize(glm::vec3(1, 1, 0));
  const scenes::Light low = makeSun({1, -0.05f, 0}), high = makeSun({1, 0.05f, 0});
  EXPECT_GT(shadeDirect(sample, {low}, tests::plainModel(), nullptr).sunDiffuse.x, 0.1);
  EXPECT_EQ(directLight(scenes::Scene(), sample, low).sunDiffuse.x, 0);
  EXPECT_GT(directLight(scenes::Scene(), sample, high).sunDiffuse.x, 0.1);
  // Of the white sky about a normal of 45 degrees, (1 + cos 45) / 2 lies above the floor.
  EXPECT_NEAR(skyShare(scenes::Scene(), sample).diffuse.x, 0.5 * (1 + std::sqrt(0.5)), 1e-3);
}

} // namespace
} // namespace parity::reference
