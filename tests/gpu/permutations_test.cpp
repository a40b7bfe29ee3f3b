// Which bins get a shader of their own.
#include <gtest/gtest.h>

#include <set>

#include "gpu/permutations.h"
#include "gpu/shaders/interface.h"

namespace parity::gpu {
namespace {

constexpr std::uint64_t kBig = 10'000'000, kSmall = 1000;

TEST(Permutations, areExactForASingleClassHoweverSmall) {
  const ClassPixels classes[] = {{{5, kFeatureNonmetal}, kSmall}};
  const auto plan = planPermutations(classes);
  EXPECT_EQ(plan[0], (Permutation{5, kFeatureNonmetal, kFeatureNonmetal}));
}

TEST(Permutations, mergeClassesWhoseSavingDoesNotPayForTheCompilation) {
  const ClassPixels classes[] = {{{1, kFeatureNonmetal}, kSmall}, {{2, 0}, kSmall}};
  const auto plan = planPermutations(classes);
  EXPECT_EQ(plan[0], plan[1]);
  EXPECT_EQ(plan[0], (Permutation{3, kFeatureNonmetal, 0}));
}

TEST(Permutations, splitOffAClassOfManyPixels) {
  const ClassPixels classes[] = {{{1, kFeatureNonmetal}, kSmall}, {{2, 0}, kBig}};
  const auto plan = planPermutations(classes);
  EXPECT_EQ(plan[1], (Permutation{2, 0, 0}));
  EXPECT_EQ(plan[0], (Permutation{1, kFeatureNonmetal, kFeatureNonmetal}));
}

TEST(Permutations, areAtMostEightAndCoverEveryClass) {
  std::vector<ClassPixels> classes;
  for (std::uint32_t i = 0; i < 30; ++i) classes.push_back({{i, i % 8}, kBig + i});
  const auto plan = planPermutations(classes);
  EXPECT_EQ(std::set<Permutation>(plan.begin(), plan.end()).size(), kMaxPermutations);
  for (std::size_t i = 0; i < classes.size(); ++i) {
    const MaterialClass& c = classes[i].materialClass;
    EXPECT_EQ(plan[i].textures & c.textures, c.textures);
    EXPECT_EQ(plan[i].mayFeatures & c.features, c.features);
    EXPECT_EQ(plan[i].mustFeatures & ~c.features, 0u) << "a feature that the class lacks must not be compiled in";
  }
}

TEST(Permutations, areSaidInWords) {
  EXPECT_EQ(describeTextures(0), "none");
  EXPECT_EQ(describeTextures(1u << kSlotBaseColor | 1u << kSlotNormal | 1u << kSlotSpecularColor | kNormalVariance),
            "base colour, normal, specular colour, spread of normals");
  EXPECT_EQ(describeFeatures({0, 0, 0}), "none");
  EXPECT_EQ(describeFeatures({0, kFeatureNonmetal | kFeatureBlend, kFeatureBlend}), "some nonmetal, blended");
  EXPECT_EQ(describeFeatures({0, kFeatureUnlit, kFeatureUnlit}), "unlit");
}

} // namespace
} // namespace parity::gpu
