// The picture: its maps show the numbers in the colours of their scales, and materials are marked at their roughness.
#include "study/plot/env_brdf_picture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "default_pair.h"
#include "study/plot/panel.h"

namespace parity::plot {
namespace {

TEST(Panel, ShowsEachPlaceInTheColourOfItsValue) {
  Canvas canvas(600, 400, {255, 255, 255});
  const ColorScale scale = scaleUpTo(1);
  drawPanel(canvas, {.x = 100,
                     .y = 50,
                     .width = 360,
                     .height = 280,
                     .caption = "roughness",
                     .value = [](double roughness, double NoV) { return 0.5 * roughness + 0.25 * NoV; },
                     .scale = scale,
                     .contours = false,
                     .marks = {}});
  for (const auto& [i, j] : {std::pair{20, 20}, {180, 140}, {340, 260}}) {
    const Rgb expected = scale.of(0.5 * (1 - (j + 0.5) / 280) + 0.25 * (i + 0.5) / 360);
    const std::uint8_t* pixel = canvas.image().at(100 + i, 50 + j);
    EXPECT_EQ((Rgb{pixel[0], pixel[1], pixel[2]}), expected) << "roughness runs upwards, N.V to the right";
  }
}

TEST(Panel, LinesOfEqualValueLieWhereTheValueIsEqual) {
  const auto draw = [](bool contours) {
    Canvas canvas(600, 400, {255, 255, 255});
    drawPanel(canvas, {.x = 100,
                       .y = 50,
                       .width = 360,
                       .height = 280,
                       .caption = "",
                       .value = [](double, double NoV) { return NoV - 0.3; },
                       .scale = scaleAbout0(0.5),
                       .contours = contours,
                       .marks = {}});
    return canvas.image();
  };
  const base::Image8 plain = draw(false), lined = draw(true);
  // Levels -.25, 0, .25 (and the ends, outside or at .8): columns of N.V = .05, .3, .55, .8.
  for (int i = 4; i < 356; ++i) {
    const double NoV = (i + 0.5) / 360;
    double nearest = 1;
    for (const double level : {0.05, 0.3, 0.55, 0.8}) nearest = std::min(nearest, std::abs(NoV - level));
    const bool isLined = plain.at(100 + i, 190)[0] != lined.at(100 + i, 190)[0] ||
                         plain.at(100 + i, 190)[1] != lined.at(100 + i, 190)[1];
    if (nearest > 2.0 / 360) {
      EXPECT_FALSE(isLined) << NoV;
    }
    if (nearest < 0.4 / 360) {
      EXPECT_TRUE(isLined) << NoV;
    }
  }
}

TEST(EnvBrdfPicture, GrowsWithTheMaterialsThatItListsUpToTwelve) {
  const PlottedPair ue4 = pairWith("ue4-2020");
  std::vector<MaterialDeviation> materials(30);
  for (std::size_t k = 0; k < materials.size(); ++k) {
    materials[k].name = "a name that is longer than its column is wide, so that it is cut off with three dots";
    materials[k].form = "general";
    materials[k].roughness = 0.5;
    materials[k].mean = 0.01 * static_cast<double>(k);
  }
  const base::Image8 none = drawEnvBrdf(ue4, {}, "");
  const base::Image8 two = drawEnvBrdf(ue4, {materials[0], materials[1]}, "scene");
  const base::Image8 all = drawEnvBrdf(ue4, materials, "scene");
  EXPECT_EQ(none.channels, 3);
  EXPECT_GT(none.width, 1200);
  EXPECT_GT(two.height, none.height);
  EXPECT_EQ(all.height - two.height, 10 * (two.height - none.height) / 5)
      << "two lines against twelve, and three of head";
}

} // namespace
} // namespace parity::plot
