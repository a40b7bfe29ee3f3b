// Mobile's colours with one term exchanged: sums, opacities, and what is not finite.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "job/view/term_variants.h"
#include "shading/terms.h"

namespace parity::job {
namespace {

using shading::kTermCount;
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
const std::vector<std::size_t> kAll = placesOf(std::vector<char>(kTermCount, 1));

// One entry whose terms are these greys; its colour is their sum, or `color`.
gpu::ShadedSurface makeShaded(const std::vector<float>& terms, float opacity = 1, bool premultiplied = false) {
  gpu::ShadedSurface shaded;
  shaded.premultiplied = premultiplied;
  shaded.terms.assign(kTermCount, gpu::ShadedPlane::zeros(1));
  float sum = 0;
  for (std::size_t t = 0; t < terms.size(); ++t) {
    shaded.terms[t] = {glm::vec4(glm::vec3(terms[t]), 0)};
    sum += terms[t];
  }
  shaded.color = {glm::vec4(glm::vec3(sum), opacity)};
  return shaded;
}

gpu::Surface makeSurface(bool blended = false) {
  gpu::Surface surface;
  surface.width = surface.height = 1;
  surface.blended = blended;
  surface.pixels = surface.instances = {0};
  return surface;
}

// Swaps what is seen of material 1, or of all.
struct Swap {
  explicit Swap(std::vector<char> wanted = {})
      : builder(materialOf, 2, 1, 1, std::vector<glm::vec3>(1 + kTermCount), std::nullopt, std::move(wanted)) {}
  std::vector<std::uint32_t> materialOf = {0, 1};
  gpu::SwapBuilder builder;
};

TEST(TermVariants, EachHasTheHighEndTermInPlaceOfItsOwn) {
  const gpu::Surface surface = makeSurface();
  const gpu::ShadedSurface highend = makeShaded({0.5f, 0.25f, 4}), mobile = makeShaded({0.125f, 0.25f, 2});
  const TermVariants variants(surface, highend, mobile, kAll, Swap().builder);
  const std::vector<gpu::SwapPlane> planes = variants.planes();
  ASSERT_EQ(planes.size(), 1 + kTermCount);
  EXPECT_EQ(planes[0].test[0].x, 2.375f) << "mobile as it is";
  EXPECT_EQ(planes[1].test[0].x, 2.75f);
  EXPECT_EQ(planes[2].test[0].x, 2.375f) << "the same term changes nothing, bit by bit";
  EXPECT_EQ(planes[3].test[0].x, 4.375f);
  for (const gpu::SwapPlane& plane : planes) EXPECT_EQ(plane.reference[0].x, 4.75f);
}

TEST(TermVariants, HighEndTermsAreTimesTheOpacityWhereMobilesAre) {
  const gpu::Surface surface = makeSurface(true);
  const gpu::ShadedSurface highend = makeShaded({0.5f}, 0.25f), mobile = makeShaded({0.0625f, 0.125f}, 0.25f, true);
  const TermVariants variants(surface, highend, mobile, kAll, Swap().builder);
  EXPECT_EQ(variants.planes()[1].test[0].x, 0.125f + 0.25f * 0.5f);
  EXPECT_EQ(variants.planes()[1].test[0].w, 0.25f);
}

TEST(TermVariants, AreMadeOfTheMaterialsThatAreSwapped) {
  const Swap swap({0, 1});
  gpu::Surface surface = makeSurface();
  EXPECT_FALSE(swap.builder.swaps(surface, 0));
  surface.instances = {1};
  EXPECT_TRUE(swap.builder.swaps(surface, 0));
  const gpu::ShadedSurface highend = makeShaded({0.5f}), mobile = makeShaded({0.125f});
  const TermVariants variants(surface, highend, mobile, kAll, swap.builder);
  EXPECT_EQ(variants.planes()[1].test[0].x, 0.5f);
}

TEST(TermVariants, ATermThatIsNaNIsFoundByItsExchange) {
  const gpu::Surface surface = makeSurface();
  const gpu::ShadedSurface highend = makeShaded({0.5f, 0.25f}), mobile = makeShaded({kNan, 0.75f});
  const TermVariants variants(surface, highend, mobile, kAll, Swap().builder);
  EXPECT_EQ(variants.planes()[1].test[0].x, 0.5f + 0.75f) << "the sum of the others, and the high-end path's";
  EXPECT_TRUE(std::isnan(variants.planes()[2].test[0].x)) << "another term does not mend it";
}

TEST(TermVariants, AreMadeOfTheTermsThatAreAskedFor) {
  const gpu::Surface surface = makeSurface();
  const gpu::ShadedSurface highend = makeShaded({0.5f, 0.25f, 4}), mobile = makeShaded({kNan, 0.25f, 2});
  const std::vector<std::size_t> terms = {2, 0};
  const TermVariants variants(surface, highend, mobile, terms, Swap().builder);
  const std::vector<gpu::SwapPlane> planes = variants.planes();
  ASSERT_EQ(planes.size(), 3u);
  EXPECT_TRUE(std::isnan(planes[1].test[0].x));
  EXPECT_EQ(planes[2].test[0].x, 0.5f + 0.25f + 2) << "a sum of all other terms, asked for or not";
}

std::vector<std::size_t> usedTerms(const gpu::ShadedSurface& highend, const gpu::ShadedSurface& mobile) {
  std::vector<char> used(kTermCount, 0);
  markUsedTerms(highend, mobile, used);
  return placesOf(used);
}

TEST(UsedTerms, AreNotZeroInEitherPath) {
  EXPECT_EQ(usedTerms(makeShaded({0, 0.5f}), makeShaded({0, 0, 1e-30f})), (std::vector<std::size_t>{1, 2}));
  EXPECT_TRUE(usedTerms(makeShaded({}), makeShaded({})).empty());
  EXPECT_EQ(usedTerms(makeShaded({kNan}), makeShaded({})), (std::vector<std::size_t>{0}));
  gpu::ShadedSurface blue = makeShaded({});
  blue.terms[7] = {glm::vec4(0, 0, -1, 0)};
  EXPECT_EQ(usedTerms(blue, makeShaded({})), (std::vector<std::size_t>{7}));
}

// Exchanging a term for one that is 0, too, mends a colour that overflowed in a sum.
TEST(UsedTerms, AreAllWhereTheTestsColorIsNotFinite) {
  gpu::ShadedSurface mobile = makeShaded({0, 0.5f});
  mobile.color = {glm::vec4(0.5f, std::numeric_limits<float>::infinity(), 0.5f, 1)};
  EXPECT_EQ(usedTerms(makeShaded({}), mobile), kAll);
}

TEST(UsedTerms, StayMarked) {
  std::vector<char> used(kTermCount, 0);
  markUsedTerms(makeShaded({1}), makeShaded({}), used);
  markUsedTerms(makeShaded({0, 1}), makeShaded({}), used);
  EXPECT_EQ(placesOf(used), (std::vector<std::size_t>{0, 1}));
}

} // namespace
} // namespace parity::job
