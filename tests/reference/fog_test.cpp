// Fog over the reference's points: where it is evaluated, and what becomes of the error.
#include <gtest/gtest.h>

#include "reference/fog.h"

namespace parity::reference {
namespace {

constexpr scenes::Fog kFog{.density = 0.1f, .color = {1, 2, 4}, .startDistance = 1, .maxOpacity = 0.75f};

scenes::Camera makeCamera(bool orthographic) {
  scenes::Camera camera; // looks along -Z
  camera.toWorld[3] = glm::vec4(1, 2, 3, 1);
  camera.orthographic = orthographic;
  return camera;
}

TEST(FogBetween, EyeAndPlaceLiesTheirDistanceOfIt) {
  const FogBetween fog = fogBetween(kFog, makeCamera(false), {1 + 3, 2, 3 - 4});
  EXPECT_NEAR(fog.transmittance, std::exp(-0.1 * (5 - 1)), 1e-7);
  EXPECT_NEAR(fog.inscattered.z, 4 * (1 - fog.transmittance), 1e-12);
  EXPECT_EQ(fogBetween(kFog, makeCamera(false), {1e4, 0, 0}).transmittance, 0.25);
}

TEST(FogBetween, OrthographicPlaneAndPlaceLiesTheirDepthOfIt) {
  EXPECT_NEAR(fogBetween(kFog, makeCamera(true), {100, -50, 3 - 4}).transmittance, std::exp(-0.1 * (4 - 1)), 1e-7);
  EXPECT_EQ(fogBetween(kFog, makeCamera(true), {100, -50, 10}).transmittance, 1) << "behind the plane";
}

TEST(SeenThrough, TermsAndErrorKeepTheirShareOfTheLight) {
  ShadedSample point;
  point.terms[0] = {1, 2, 3};
  point.terms[5] = {3, 2, 1};
  point.standardError = 0.4f;
  point.relativeError = 0.1f; // of a colour of 4
  point.samples = 256;
  const ShadedSample behind = seenThrough({.inscattered = {0, 0, 2}, .transmittance = 0.5}, point);
  EXPECT_EQ(behind.terms[0], glm::vec3(0.5f, 1, 1.5f));
  EXPECT_EQ(behind.terms[5], glm::vec3(1.5f, 1, 0.5f));
  EXPECT_EQ(behind.terms[static_cast<std::size_t>(shading::Term::fog)], glm::vec3(0, 0, 2));
  EXPECT_FLOAT_EQ(behind.standardError, 0.2f);
  EXPECT_FLOAT_EQ(behind.relativeError, 0.05f) << "0.2 of a colour of 4: half the light is the fog's";
  EXPECT_EQ(behind.samples, 256u);
}

} // namespace
} // namespace parity::reference
