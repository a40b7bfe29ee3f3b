// The sun's shadow by a map on mobile: there near the eye, gone from its distance on, beside the baked one.
#include "mobile/shadow_fixture.h"

#include <algorithm>

#include "mobile/presets.h"

namespace parity::mobile {
namespace {

scenes::Light makeSun() {
  scenes::Light light;
  light.kind = scenes::LightKind::directional;
  light.color = glm::vec3(3);
  light.direction = glm::normalize(glm::vec3(0.5f, 0, -1)); // its shadow lies half of the height towards +X
  return light;
}

class SunShadowTest : public ShadowTest {
protected:
  Picture render(const Options& options, const std::vector<scenes::Light>& lights = {makeSun()}) {
    return ShadowTest::render(lights, options);
  }
  static glm::vec2 placeOf(std::size_t pixel) {
    return {(static_cast<float>(pixel % kShadowedSide) + 0.5f) / kShadowedSide * 4 - 2,
            2 - (static_cast<float>(pixel / kShadowedSide) + 0.5f) / kShadowedSide * 4};
  }
};

TEST_F(SunShadowTest, LiesWhereTheSquareHidesTheSun) {
  for (const Precision precision : {Precision::fp16, Precision::fp32}) {
    Options options;
    options.precision = precision;
    const Picture open = render(options);
    options.sunShadow = true;
    const Picture shadowed = render(options);
    int dark = 0, lit = 0;
    for (std::size_t p = 0; p < open.lit.size(); ++p) {
      if (open.lit[p] <= 0) continue;
      const glm::vec2 d = glm::abs(placeOf(p) - glm::vec2(0.5f, 0)); // from the shadow's middle
      const float r = std::max(d.x, d.y);
      if (r < 0.47f) {
        EXPECT_EQ(shadowed.lit[p], 0) << placeOf(p).x << " " << placeOf(p).y;
        ++dark;
      } else if (r > 0.53f) {
        EXPECT_EQ(shadowed.lit[p], open.lit[p]) << placeOf(p).x << " " << placeOf(p).y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 400);
    EXPECT_GT(lit, 7000);
  }
}

// The floor is half a metre along the view: within the distance, beyond it, and half of the way between, where a
// fourth of the light is back.
TEST_F(SunShadowTest, IsThereNearAndGoneFromItsDistanceOn) {
  Options options = tests::inFp32("ue4-2020");
  const Picture open = render(options);
  options.sunShadow = true;
  const std::size_t middle = kShadowedSide / 2 * kShadowedSide + kShadowedSide / 2 + kShadowedSide / 8; // x = .5
  ASSERT_GT(open.lit[middle], 0);
  for (const auto& [distance, fade, light] : {std::tuple{200.f, 0.1f, 0.0f},
                                              {0.55f, 0.05f, 0.0f},
                                              {0.4f, 0.5f, 1.0f},
                                              {0.49f, 0.f, 1.0f},
                                              {2.f / 3, 0.5f, 0.25f}}) {
    options.sunShadowDistance = distance;
    options.sunShadowFade = fade;
    const Picture shadowed = render(options);
    EXPECT_NEAR(shadowed.lit[middle], light * open.lit[middle], 1e-3f * open.lit[middle]) << distance << " " << fade;
    EXPECT_EQ(shadowed.lit[kShadowedSide + 1], open.lit[kShadowedSide + 1]) << "lit stays lit";
  }
}

TEST_F(SunShadowTest, IsNotedWhereThereIsNoSun) {
  Options options;
  options.sunShadow = true;
  scenes::Light lamp;
  lamp.position = {0, 0, 0.4f};
  EXPECT_EQ(render(options, {lamp}).notes,
            std::vector<std::string>{"--mobile-sun-shadow has no effect: the scene has no sun"});
  EXPECT_TRUE(Renderer::needsShadowMaps({lamp}, options).empty());
}

// The sun's and the spot light's maps lie in one image: each light has its own.
TEST_F(SunShadowTest, StandsBesideTheSpotLights) {
  Options options = tests::inFp32("ue4-2020");
  scenes::Light spot;
  spot.kind = scenes::LightKind::spot;
  spot.color = glm::vec3(5);
  spot.position = {0, 0, 3};
  spot.direction = {0, 0, -1};
  spot.outerConeAngle = glm::radians(50.f);
  const std::size_t both = kShadowedSide / 2 * kShadowedSide + kShadowedSide / 2 + kShadowedSide / 8,
                    ofSpot = kShadowedSide / 2 * kShadowedSide + kShadowedSide / 2 - kShadowedSide / 8;
  const auto at = [&](bool sunCasts, bool spotCasts, std::size_t pixel) {
    options.sunShadow = sunCasts;
    options.spotShadow = spotCasts;
    return render(options, {makeSun(), spot}).lit[pixel];
  };
  EXPECT_EQ(at(true, true, both), 0);
  EXPECT_GT(at(true, false, both), 0) << "by the spot light";
  EXPECT_GT(at(false, true, both), 0) << "by the sun";
  EXPECT_EQ(at(true, true, ofSpot), at(false, true, ofSpot)) << "the sun's shadow is elsewhere";
  EXPECT_LT(at(true, true, ofSpot), at(true, false, ofSpot));
}

} // namespace
} // namespace parity::mobile
