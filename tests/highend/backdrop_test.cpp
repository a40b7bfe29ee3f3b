// What the paths read of what is rendered behind glass: where, how wide, and over the environment.
#include "highend_quad.h"

#include <limits>

#include "support/look_through.h"

namespace parity::highend {
namespace {

using tests::makePaneBeforeWall;

class BackdropTest : public HighendTest {
protected:
  base::Image lut = makeEnvBrdfLut(GeometryTerm::heightCorrelated);

  base::Image lookThrough(const scenes::Scene& scene, Inputs inputs, const scenes::Camera& camera,
                          bool withBackdrop = true) {
    inputs.lut = &lut, inputs.transmits = true, inputs.terms = true;
    const tests::LookedThrough seen = tests::lookThrough(
        device(), scene, camera,
        [&](const auto& buffers, const auto& kinds) { return Renderer(device(), buffers, kinds, inputs, {}); },
        withBackdrop);
    EXPECT_TRUE(seen.readsBackdrop);
    return seen.image;
  }
};

const scenes::Camera kOrthographic = tests::makeFrontCamera(1, 3, true),
                     kPerspective = tests::makeFrontCamera(0.5f, 3, false);

TEST_F(BackdropTest, ASmoothPaneShowsTheWallBehindIt) {
  for (const scenes::Camera& camera : {kOrthographic, kPerspective}) {
    const base::Image seen = lookThrough(makePaneBeforeWall(0, 1), {}, camera);
    for (const int x : {8, 24}) {
      EXPECT_NEAR(seen.at(x, 32)[0], 0.96f, 0.01f) << x;
      EXPECT_NEAR(seen.at(x, 32)[2], 0, 1e-3f) << x;
      EXPECT_NEAR(seen.at(63 - x, 32)[2], 0.96f, 0.01f) << x;
    }
    EXPECT_EQ(lookThrough(makePaneBeforeWall(0, 1), {}, camera, false).at(8, 32)[0], 0)
        << "no backdrop, no environment";
  }
}

// The farther the wall, the wider is what a rough pane mixes; against it a wall stays sharp.
TEST_F(BackdropTest, ARoughPaneBlursWithTheDistance) {
  const auto mixedAt = [&](float roughness, float distance) {
    return lookThrough(makePaneBeforeWall(roughness, distance), {}, kOrthographic)
        .at(26, 32)[2]; // 0.17 m left of the border
  };
  EXPECT_LT(mixedAt(0.3f, 0.05f), 0.01f);
  EXPECT_GT(mixedAt(0.3f, 1.5f), 0.05f);
  EXPECT_GT(mixedAt(0.5f, 1.5f), mixedAt(0.3f, 1.5f));
}

TEST_F(BackdropTest, WhereNothingIsBehindTheEnvironmentShows) {
  const gpu::EnvironmentMaps sky = tests::makeConstantEnvironment(device(), 0.5f);
  scenes::Scene scene = makePaneBeforeWall(0, 1);
  scene.instances.pop_back(); // the blue wall
  const base::Image seen = lookThrough(scene, {.environment = &sky}, kOrthographic);
  EXPECT_NEAR(seen.at(50, 32)[0], 0.5f * 0.96f, 0.02f);
  EXPECT_NEAR(seen.at(50, 32)[2], 0.5f * 0.96f, 0.02f);
  EXPECT_NEAR(seen.at(10, 32)[0], 0.96f, 0.05f) << "and the wall where it is";
  EXPECT_NEAR(seen.at(10, 32)[2], 0, 0.02f);
}

// A ball turns what is far behind it round.
TEST_F(BackdropTest, ABodyBendsWhatIsBehind) {
  scenes::Scene scene = makePaneBeforeWall(0, 4, 1);
  scene.meshes[0].normals = {{-0.5f, 0, 0.866f}, {0.5f, 0, 0.866f}, {0.5f, 0, 0.866f}, {-0.5f, 0, 0.866f}};
  const base::Image seen = lookThrough(scene, {}, kOrthographic);
  EXPECT_GT(seen.at(18, 32)[2], 0.5f) << "the left shows the right wall";
  EXPECT_LT(seen.at(18, 32)[0], 0.1f);
}

TEST_F(BackdropTest, PixelsThatAreNotFiniteCountAsBlack) {
  scenes::Scene scene = makePaneBeforeWall(0, 1);
  scene.materials[1].emissive = glm::vec3(std::numeric_limits<float>::infinity());
  const base::Image seen = lookThrough(scene, {}, kOrthographic);
  for (const float value : seen.pixels) EXPECT_TRUE(std::isfinite(value));
}

} // namespace
} // namespace parity::highend
