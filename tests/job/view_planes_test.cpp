// Which values of a view are written beside its pictures.
#include "job/view/view_planes.h"

#include <gtest/gtest.h>

#include "shading/terms.h"

namespace parity::job {
namespace {

const std::vector<Column> kColumns = {{"highend", nullptr, {}}, {"mobile", nullptr, {}}};

ViewFrames makeFrames() {
  ViewFrames frames;
  frames.paths.resize(2);
  frames.paths[0].frame.color = base::Image(3, 2, 3, 0.5f);
  frames.paths[1].frame.color = base::Image(3, 2, 3, 0.25f);
  frames.coverage = {
      {"first", {0, 1, 4}, {1, 0.4f, 0.5f}}, {"second", {1, 2}, {}}, {"third", {1, 4, 5}, {0.6f, 0.5f, 1}}};
  return frames;
}

// Of the pixels of each material, in the order of its list.
const std::vector<std::vector<float>> kMaterialFlip = {{0.1f, 0.2f, 0.3f}, {0.4f, 0.5f}, {0.6f, 0.7f, 0.8f}};

std::vector<std::string> namesOf(const std::vector<report::PixelPlane>& planes) {
  std::vector<std::string> names;
  for (const report::PixelPlane& plane : planes) names.push_back(plane.name);
  return names;
}

TEST(ViewPlanes, AreBothPathsFlipAndMaterials) {
  ViewFrames frames = makeFrames();
  const base::Image flip(3, 2, 1, 0.1f);
  const ViewPlanes planes = planesOf(frames, kColumns, 0, 1, flip, kMaterialFlip, {0, 1, 2});
  EXPECT_EQ(namesOf(planes.color), (std::vector<std::string>{"highend", "mobile", "flip", "materialFlip", "material"}));
  EXPECT_EQ(planes.color[0].values, &frames.paths[0].frame.color);
  EXPECT_EQ(planes.color[1].values, &frames.paths[1].frame.color);
  EXPECT_EQ(planes.color[2].values, &flip);
  EXPECT_EQ(planes.color[2].kind, report::PlaneKind::unorm16);
  EXPECT_EQ(planes.color[3].kind, report::PlaneKind::unorm16);
  EXPECT_EQ(planes.color[4].kind, report::PlaneKind::uint16);
  EXPECT_TRUE(planes.terms.empty());
  frames.truth.color = base::Image(3, 2, 3, 1.f);
  EXPECT_EQ(namesOf(planesOf(frames, kColumns, 0, 1, flip, {kMaterialFlip[0]}, {0}).color),
            (std::vector<std::string>{"highend", "mobile", "truth", "flip", "materialFlip", "material"}));
}

TEST(ViewPlanes, APixelIsOfTheMaterialThatCoversMostOfItAndHasThatOnesFlip) {
  const ViewFrames frames = makeFrames();
  const base::Image flip(3, 2, 1, 0.9f);
  const auto expectPlanes = [&](const std::vector<std::size_t>& chosen, const std::vector<float>& numbers,
                                const std::vector<float>& ownFlip, const char* what) {
    std::vector<std::vector<float>> materialFlip;
    for (const std::size_t m : chosen) materialFlip.push_back(kMaterialFlip[m]);
    const ViewPlanes planes = planesOf(frames, kColumns, 0, 1, flip, materialFlip, chosen);
    ASSERT_EQ(planes.color.size(), 5u) << what;
    EXPECT_EQ(planes.color[3].values->pixels, ownFlip) << what;
    EXPECT_EQ(planes.color[4].values->pixels, numbers) << what;
  };
  expectPlanes({0, 1, 2}, {1, 2, 2, 0, 1, 3}, {0.1f, 0.4f, 0.5f, 0, 0.3f, 0.8f}, "the first of equals");
  expectPlanes({2, 0}, {2, 1, 0, 0, 1, 1}, {0.1f, 0.6f, 0, 0, 0.7f, 0.8f}, "places among the chosen ones");
  expectPlanes({}, std::vector<float>(6, 0), std::vector<float>(6, 0), "none is chosen");
}

TEST(ViewPlanes, TermsThatAreBlackInBothAreLeftOut) {
  ViewFrames frames = makeFrames();
  EXPECT_TRUE(termPlanesOf(frames, kColumns, 1).empty());
  for (PathFrames& path : frames.paths) path.frame.terms.assign(shading::kTermCount, base::Image(3, 2, 3));
  EXPECT_TRUE(termPlanesOf(frames, kColumns, 1).empty());
  frames.paths[0].frame.terms[1].pixels[17] = 1e-6f;
  frames.paths[1].frame.terms[6].pixels[0] = std::nanf("");
  const std::string first(shading::kTermNames[1]), second(shading::kTermNames[6]);
  const std::vector<report::PixelPlane> planes = termPlanesOf(frames, kColumns, 1);
  EXPECT_EQ(namesOf(planes),
            (std::vector<std::string>{"highend." + first, "mobile." + first, "highend." + second, "mobile." + second}));
  EXPECT_EQ(planes[3].values, &frames.paths[1].frame.terms[6]);
}

} // namespace
} // namespace parity::job
