// What is planted in a picture is found.
#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

#include "shading/terms.h"
#include "study/stress/render_stress.h"

namespace parity::tests {
namespace {

using namespace stress;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();

// 4x4 pixels of 1, .75 of it in one term and .25 in another.
PathFrame makeFrame(const std::string& preset, bool half) {
  PathFrame path{.path = preset.empty() ? "highend" : "mobile " + preset, .preset = preset, .half = half, .frame = {}};
  const auto constant = [](float value) {
    base::Image image(4, 4, 3);
    std::fill(image.pixels.begin(), image.pixels.end(), value);
    return image;
  };
  path.frame.color = constant(1);
  for (std::size_t t = 0; t < shading::kTermCount; ++t)
    path.frame.terms.push_back(constant(t == 0 ? 0.75f : t == 5 ? 0.25f : 0.f));
  return path;
}

StressScene makeScene(float roughness) {
  StressScene scene;
  scene.name = "test";
  scene.leastRoughness = {roughness};
  return scene;
}

SceneFrames makeFrames(PathFrame path) {
  SceneFrames frames;
  frames.paths.push_back(std::move(path));
  frames.coverage = {{.name = "material", .pixels = {0, 1, 2, 3, 5}, .weights = {}}};
  return frames;
}

TEST(FrameChecks, AGoodFrameHasNoFindings) {
  for (const char* preset : {"", "ue4-2020", "karis2014"})
    EXPECT_TRUE(checkFrames(makeScene(0.5f), makeFrames(makeFrame(preset, true)), nullptr).empty());
}

TEST(FrameChecks, APlantedNanIsFoundWithItsPixel) {
  for (const bool inTerm : {false, true}) {
    PathFrame path = makeFrame("ue4-2020", true);
    (inTerm ? path.frame.terms[3] : path.frame.color).pixels[3 * 6 + 1] = kNan;
    const std::vector<Finding> found = checkFrames(makeScene(0), makeFrames(std::move(path)), nullptr);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0].fault, "not finite");
    EXPECT_FALSE(found[0].expected);
    EXPECT_NE(found[0].example.find("x 2, y 1"), std::string::npos) << found[0].example;
  }
}

TEST(FrameChecks, InfinityOfKaris2014IsExpectedOnSmoothMaterialsAlone) {
  const auto findingsAt = [](std::size_t pixel, float roughness, bool half) {
    PathFrame path = makeFrame("karis2014", half);
    path.frame.color.pixels[3 * pixel] = std::numeric_limits<float>::infinity();
    return checkFrames(makeScene(roughness), makeFrames(std::move(path)), nullptr);
  };
  EXPECT_TRUE(findingsAt(5, 0.05f, true).at(0).expected);
  EXPECT_FALSE(findingsAt(5, 0.2f, true).at(0).expected) << "too rough";
  EXPECT_FALSE(findingsAt(5, 0.05f, false).at(0).expected) << "single does not fail there";
  EXPECT_FALSE(findingsAt(6, 0.05f, true).at(0).expected) << "no such material at that pixel";
}

TEST(FrameChecks, AKnownFailureThatVanishedIsFound) {
  StressScene scene = makeScene(0);
  scene.karisMustFail = true;
  const std::vector<Finding> found = checkFrames(scene, makeFrames(makeFrame("karis2014", true)), nullptr);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_FALSE(found[0].expected);
  EXPECT_EQ(found[0].fault, "vanished: not finite");
  EXPECT_TRUE(checkFrames(scene, makeFrames(makeFrame("refit", true)), nullptr).empty());
}

TEST(FrameChecks, TermsThatDoNotAddUpAreFoundAtTheirTolerance) {
  const auto count = [](const char* preset, bool half, float off) {
    PathFrame path = makeFrame(preset, half);
    path.frame.terms[0].pixels[7] += off;
    return checkFrames(makeScene(0.5f), makeFrames(std::move(path)), nullptr).size();
  };
  EXPECT_EQ(count("", false, 0.0009f), 0u);
  EXPECT_EQ(count("", false, 0.0012f), 1u);
  EXPECT_EQ(count("refit", true, 0.0035f), 0u);
  EXPECT_EQ(count("refit", true, 0.0045f), 1u);
  EXPECT_EQ(count("refit", false, 0.0035f), 1u);
}

TEST(FrameChecks, AColourThatSaturatedMayBeLessThanItsTermsButNotMore) {
  const auto count = [](float color, float term) {
    PathFrame path = makeFrame("ue4-2020", true);
    std::fill(path.frame.terms[0].pixels.begin(), path.frame.terms[0].pixels.end(), term);
    std::fill(path.frame.color.pixels.begin(), path.frame.color.pixels.end(), color);
    SceneFrames frames = makeFrames(std::move(path));
    frames.coverage[0].weights.assign(frames.coverage[0].pixels.size(), 0.5f); // half opaque
    frames.coverage[0].pixels = {0, 1, 2, 3, 4};
    return checkFrames(makeScene(0.5f), frames, nullptr).size();
  };
  EXPECT_EQ(count(65504, 90000), 0u);
  EXPECT_EQ(count(65504, 40000), 1u);
  EXPECT_EQ(count(30000, 31000), 1u) << "no saturation there: not all of it is half opaque";
}

TEST(FrameChecks, TheScenesOwnCheckSpeaks) {
  StressScene scene = makeScene(0.5f);
  scene.check = [](const SceneFrames&, const SceneFrames*) { return std::vector<std::string>{"no"}; };
  const std::vector<Finding> found = checkFrames(scene, makeFrames(makeFrame("", false)), nullptr);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].example, "no");
}

TEST(FrameChecks, NothingRenderedIsAFinding) {
  EXPECT_EQ(checkFrames(makeScene(1), {}, nullptr).size(), 1u);
  PathFrame withoutTerms = makeFrame("", false);
  withoutTerms.frame.terms.clear();
  EXPECT_EQ(checkFrames(makeScene(1), makeFrames(std::move(withoutTerms)), nullptr).size(), 1u);
}

TEST(FrameChecks, TwoRenderingsAreHeldTogetherBitByBit) {
  const PathFrame first = makeFrame("", false);
  PathFrame second = first;
  EXPECT_TRUE(checkSame(makeScene(1), first, second).empty());
  second.frame.terms[8].pixels[0] = -0.f; // equal to 0, another bit
  EXPECT_EQ(checkSame(makeScene(1), first, second).size(), 1u);
}

} // namespace
} // namespace parity::tests
