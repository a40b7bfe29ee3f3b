// Light of each kind at a point, against KHR_lights_punctual's own formulas.
#include "bake/light/direct_light.h"

#include <gtest/gtest.h>

#include <limits>

#include "bake/bake_scenes.h"
#include "bake/baked_light.h"

namespace parity::bake {
namespace {

using namespace tests;

// A floor with a roof of a square metre, 1 m above its middle.
class DirectLight : public testing::Test {
protected:
  DirectLight() : m_scene(make()), m_visibility(m_scene) {}
  static scenes::Scene make() {
    scenes::Scene scene;
    addObject(scene, square(4), matte("floor", 0.5f));
    addObject(scene, square(0.5f), matte("roof", 0.5f), glm::translate(glm::mat4(1.f), glm::vec3(0, 1, 0)));
    return scene;
  }
  LightSum at(const glm::vec3& position, const scenes::Light& light, bool bothSides = false,
              const glm::vec3& normal = {0, 1, 0}) const {
    LightSum sum;
    m_reached = addLight(light, {position, normal, normal, 0}, bothSides, m_visibility, sum);
    return sum;
  }
  const scenes::Scene m_scene;
  const lighting::Visibility m_visibility;
  mutable bool m_reached = false;
};

TEST_F(DirectLight, OfASpotFallsOffTowardsItsCone) {
  scenes::Light light = pointLight({2, 2, 0}, {10, 20, 30});
  light.kind = scenes::LightKind::spot;
  light.direction = {0, -1, 0};
  light.innerConeAngle = 0.2f;
  light.outerConeAngle = 0.5f;
  for (const double x : {0.0, 0.3, 0.5, 0.8, 1.0, 1.2}) {
    const double angle = std::atan2(x, 2), d2 = 4 + x * x;
    // lightAngleScale and lightAngleOffset of the extension.
    const double scale = 1 / std::max(0.001, std::cos(0.2) - std::cos(0.5));
    const double cone = std::clamp((std::cos(angle) - std::cos(0.5)) * scale, 0.0, 1.0);
    const double expected = cone * cone / d2 * std::cos(angle);
    const LightSum sum = at({2 + x, 0, 0}, light);
    EXPECT_NEAR(sum.irradiance.x, 10 * expected, 1e-5) << x;
    EXPECT_NEAR(sum.irradiance.z, 30 * expected, 3e-5) << x;
    EXPECT_EQ(m_reached, expected > 0) << x;
  }
}

TEST_F(DirectLight, EndsAtTheRange) {
  scenes::Light light = pointLight({3, 2, 0}, {5, 5, 5});
  light.range = 2.5f;
  EXPECT_NEAR(at({3, 0, 0}, light).irradiance.x, 5 * (1 - std::pow(2 / 2.5, 4)) / 4, 1e-5);
  EXPECT_EQ(at({3, 0, 1.6f}, light).irradiance.x, 0);
  EXPECT_FALSE(m_reached);
  light.range = 0; // infinite
  EXPECT_GT(at({3, 0, 1.6f}, light).irradiance.x, 0);
}

TEST_F(DirectLight, FadesAsTheLightSays) {
  scenes::Light light = pointLight({3, 2, 0}, {5, 5, 5});
  light.range = 2.5f;
  light.falloff = scenes::Falloff::ue4;
  EXPECT_NEAR(at({3, 0, 0}, light).irradiance.x, 5 * std::pow(1 - std::pow(2 / 2.5, 4), 2) / (4 + 1e-4), 1e-5);
  light.falloff = scenes::Falloff::exponent;
  light.falloffExponent = 3;
  EXPECT_NEAR(at({3, 0, 0}, light).irradiance.x, 5 * std::pow(1 - std::pow(2 / 2.5, 2), 3), 1e-5);
  EXPECT_EQ(at({3, 0, 1.6f}, light).irradiance.x, 0) << "beyond the range";
}

TEST_F(DirectLight, OfASunHasNoDistanceAndIsStopped) {
  scenes::Light sun = pointLight({}, {2, 3, 4});
  sun.kind = scenes::LightKind::directional;
  sun.direction = glm::normalize(glm::vec3(-1, -1, 0));
  const LightSum sum = at({3, 0, 0}, sun);
  EXPECT_NEAR(sum.irradiance.y, 3 * std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(sum.sh.y, lightmapLuminance({2, 3, 4}) * kY1 * std::sqrt(0.5), 1e-6);
  EXPECT_EQ(at({-1, 0, 0}, sun).irradiance.y, 0) << "the roof stands between";
  EXPECT_GT(at({-2, 0, 0}, sun).irradiance.y, 0) << "and here no more";
}

TEST_F(DirectLight, FromBehindAddsToDirectionsOfDoubleSidedSurfacesAlone) {
  const scenes::Light light = pointLight({2, -1, 0}, {1, 1, 1});
  EXPECT_EQ(at({2, 0, 0}, light).sh.x, 0);
  EXPECT_FALSE(m_reached);
  const LightSum both = at({2, 0, 0}, light, true);
  EXPECT_TRUE(m_reached);
  EXPECT_EQ(both.irradiance, glm::dvec3(0));
  EXPECT_NEAR(both.sh.z, -kY1, 1e-6);
}

TEST_F(DirectLight, AtTheLightItselfIsNone) {
  EXPECT_EQ(at({2, 0, 0}, pointLight({2, 0, 0}, {1, 1, 1})).irradiance, glm::dvec3(0));
  const LightSum near = at({2, 0, 0}, pointLight({2, 0.001f, 0}, {1, 1, 1}));
  EXPECT_TRUE(std::isfinite(near.irradiance.x));
  EXPECT_LE(near.irradiance.x, 1e4 * (1 + 1e-6)) << "no nearer than a centimetre";
}

// A sky of radiance 2, 3, 4 everywhere has their luminance.
TEST(Capture, AverageBrightnessIsTheMeanLuminance) {
  const std::vector<glm::vec4> texels(std::size_t{6} * 32 * 32, glm::vec4(2, 3, 4, 1));
  Capture capture;
  capture.light = std::make_shared<const lighting::EnvironmentLight>(
      lighting::makeEnvironmentLight(texels, {.faceSize = 32, .sampleCount = 4}));
  EXPECT_NEAR(capture.averageBrightness(), 0.3 * 2 + 0.59 * 3 + 0.11 * 4, 1e-3);
}

} // namespace
} // namespace parity::bake
