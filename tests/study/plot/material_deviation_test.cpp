// How far the approximation is from the table on materials: against the same mean taken here by Gauss's rule.
#include "study/plot/material_deviation.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "default_pair.h"
#include "shading/quadrature.h"
#include "support/small_scenes.h"

namespace parity::plot {
namespace {

scenes::Scene makeScene() {
  scenes::Scene scene = tests::makeQuadScene();
  scenes::Material& m = scene.materials[0];
  m.name = "copper";
  m.baseColor = glm::vec4(0.9f, 0.6f, 0.3f, 1);
  m.metallic = 1;
  m.roughness = 0.4f;
  return scene;
}

TEST(MaterialDeviation, IsTheMeanOverASpheresNoV) {
  const scenes::Scene scene = makeScene();
  const auto deviations = deviationsOf(scene, pairWith("karis2014"));
  ASSERT_EQ(deviations.size(), 1u);
  const MaterialDeviation& d = deviations[0];
  double mean = 0, bias = 0, max = 0;
  const tests::GaussRule rule(48);
  const double F0[] = {0.9, 0.6, 0.3};
  for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
    const double NoV = 0.5 + 0.5 * rule.nodes[i];
    const tests::EnvBrdf truth = tests::integrateEnvBrdf(tests::Geometry::heightCorrelated, 0.4, NoV);
    const double rx = 0.6, ry = 0.0425 - 0.0275 * 0.4, rz = 1.04 - 0.572 * 0.4, rw = 0.022 * 0.4 - 0.04;
    const double a004 = std::min(rx * rx, std::exp2(-9.28 * NoV)) * rx + ry;
    for (const double f : F0) {
      const double error = f * (rz - 1.04 * a004) + 1.04 * a004 + rw - (f * truth.A + truth.B);
      mean += 0.5 * rule.weights[i] * 2 * NoV * std::abs(error) / 3;
      bias += 0.5 * rule.weights[i] * 2 * NoV * error / 3;
      if (NoV >= 0.05) max = std::max(max, std::abs(error));
    }
  }
  EXPECT_NEAR(d.mean, mean, 1e-3);
  EXPECT_NEAR(d.bias, bias, 1e-3);
  EXPECT_NEAR(d.max, max, 5e-3);
  EXPECT_GT(d.mean, 0.01) << "there is something to be seen";
  EXPECT_EQ(d.points, 1u);
  EXPECT_EQ(d.form, "general");
  EXPECT_NEAR(d.F0.y, 0.6, 1e-6);
  EXPECT_NEAR(d.roughness, 0.4, 1e-6);
  EXPECT_GT(d.referenceMultiple, 0);
  EXPECT_EQ(d.testMultiple, 0);
}

TEST(MaterialDeviation, FollowsTheTexturesOverTheSurface) {
  scenes::Scene scene = makeScene();
  // Metallic-roughness: the left half smooth, the right half rough, both of metal.
  scenes::TextureImage image{"halves", base::Image8(64, 4, 4, 255)};
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 64; ++x) image.pixels.at(x, y)[1] = x < 32 ? 51 : 204; // .2 and .8
  scene.images.push_back(image);
  scene.materials[0].metallicRoughnessTexture.image = 0;
  scene.materials[0].roughness = 1;
  const PlottedPair ue4 = pairWith("ue4-2020");
  const MaterialDeviation both = deviationsOf(scene, ue4)[0];
  EXPECT_EQ(both.points, 256u);
  EXPECT_NEAR(both.roughness, 0.5, 0.01);
  EXPECT_NEAR(both.least, 0.2, 1e-6);
  EXPECT_NEAR(both.greatest, 0.8, 1e-6);
  double mean = 0;
  for (const float roughness : {0.2f, 0.8f}) {
    scenes::Scene plain = makeScene();
    plain.materials[0].roughness = roughness;
    mean += 0.5 * deviationsOf(plain, ue4)[0].mean;
  }
  EXPECT_NEAR(both.mean, mean, 0.02 * mean);
}

TEST(MaterialDeviation, TakesNonmetalsAndFullyRoughOnesByTheirOwnFormsAndLeavesUnlitOnesOut) {
  scenes::Scene scene = makeScene();
  scene.materials.resize(4, scene.materials[0]);
  scene.materials[1].metallic = 0;
  scene.materials[2].fullyRough = true;
  scene.materials[3].unlit = true;
  const auto deviations = deviationsOf(scene, pairWith("ue4-2020"));
  ASSERT_EQ(deviations.size(), 3u);
  EXPECT_EQ(deviations[1].form, "nonmetal");
  EXPECT_NEAR(deviations[1].F0.x, 0.04, 1e-6);
  EXPECT_EQ(deviations[2].form, "fully rough");
  EXPECT_NE(deviations[2].mean, deviations[0].mean);
}

// The preset that is fitted to this table is nearer to it.
TEST(MaterialDeviation, OfRefitIsSmaller) {
  const scenes::Scene scene = makeScene();
  const double refit = deviationsOf(scene, pairWith("refit"))[0].mean;
  const double ue4 = deviationsOf(scene, pairWith("ue4-2020"))[0].mean;
  EXPECT_LT(refit, 0.5 * ue4);
}

} // namespace
} // namespace parity::plot
