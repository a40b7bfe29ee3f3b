// The one spot light that casts a shadow on mobile: where similar triangles put it.
#include "mobile/shadow_fixture.h"

#include <algorithm>

#include "mobile/presets.h"

namespace parity::mobile {
namespace {

scenes::Light makeSpot(float intensity) {
  scenes::Light light;
  light.kind = scenes::LightKind::spot;
  light.color = glm::vec3(intensity);
  light.position = {0, 0, 3};
  light.direction = {0, 0, -1};
  light.outerConeAngle = glm::radians(50.f);
  light.innerConeAngle = glm::radians(49.f);
  return light;
}

class SpotShadowTest : public ShadowTest {
protected:
  std::vector<float> floor(const std::vector<scenes::Light>& lights, const Options& options,
                           std::uint32_t mapSize = 2048) {
    Picture picture = render(lights, options, mapSize);
    EXPECT_EQ(picture.mapCount.value_or(1), 1u);
    m_notes = picture.notes;
    return picture.lit;
  }
  std::vector<std::string> m_notes;
};

TEST_F(SpotShadowTest, LiesWhereTheSquareHidesTheLight) {
  for (const Precision precision : {Precision::fp16, Precision::fp32}) {
    Options options;
    options.precision = precision;
    const std::vector<float> open = floor({makeSpot(5)}, options);
    options.spotShadow = true;
    const std::vector<float> shadowed = floor({makeSpot(5)}, options);
    int dark = 0, lit = 0;
    for (std::size_t p = 0; p < open.size(); ++p) {
      const float x = std::abs((static_cast<float>(p % kShadowedSide) + 0.5f) / kShadowedSide * 4 - 2);
      const float y = std::abs((static_cast<float>(p / kShadowedSide) + 0.5f) / kShadowedSide * 4 - 2);
      const float r = std::max(x, y);
      if (open[p] <= 0) continue;
      if (r < 0.72f) {
        EXPECT_EQ(shadowed[p], 0) << x << " " << y;
        ++dark;
      } else if (r > 0.78f) {
        EXPECT_EQ(shadowed[p], open[p]) << x << " " << y;
        ++lit;
      }
    }
    EXPECT_GT(dark, 800);
    EXPECT_GT(lit, 2000);
  }
}

TEST_F(SpotShadowTest, FadeLetsLightThroughAndSharpenNarrowsTheEdge) {
  constexpr std::uint32_t kCoarse = 64; // texels as wide as two pixels, so that there is an edge to be seen
  Options options = tests::inFp32("ue4-2020");
  const std::vector<float> open = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadow = true;
  const std::vector<float> plain = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadowFade = 0.25f;
  const std::vector<float> faded = floor({makeSpot(5)}, options, kCoarse);
  options.spotShadowFade = 1;
  options.spotShadowSharpen = 8;
  const std::vector<float> sharp = floor({makeSpot(5)}, options, kCoarse);
  int partly = 0, partlySharp = 0;
  for (std::size_t p = 0; p < open.size(); ++p) {
    // lerp(1, S^2, .25), with S^2 from the picture whose fade is 1.
    EXPECT_NEAR(faded[p], open[p] + 0.25f * (plain[p] - open[p]), 1e-5f * open[p]);
    partly += plain[p] > 0.02f * open[p] && plain[p] < 0.98f * open[p];
    partlySharp += sharp[p] > 0.02f * open[p] && sharp[p] < 0.98f * open[p];
  }
  EXPECT_GT(partly, 0);
  EXPECT_LT(partlySharp, partly);
}

TEST_F(SpotShadowTest, OfSeveralSpotsTheBrightestHasOne) {
  Options options;
  options.spotShadow = true;
  const std::size_t middle = kShadowedSide * kShadowedSide / 2 + kShadowedSide / 2;
  const float faint = floor({makeSpot(2)}, Options{})[middle];
  EXPECT_EQ(floor({makeSpot(2), makeSpot(5)}, options)[middle], faint);
  EXPECT_EQ(m_notes, (std::vector<std::string>{"1 of 2 spot lights cast no shadow: only the brightest does"}));
  options.localLights = false;
  EXPECT_TRUE(Renderer::needsShadowMaps({makeSpot(2)}, options).empty()) << "all are baked";
  EXPECT_EQ(floor({makeSpot(2), makeSpot(5)}, options)[middle], 0);
}

} // namespace
} // namespace parity::mobile
