// Which bins get a shader of their own.
#include <gtest/gtest.h>

#include <set>

#include "gpu/shaders/interface.h"
#include "gpu/surface/permutations.h"

namespace parity::gpu {
namespace {

constexpr std::uint64_t kBig = 10'000'000, kSmall = 1000;

constexpr std::uint32_t kAllTextures = 0xff;

// The permutations of these classes, seen at once, in their order.
std::vector<Permutation> planAll(const std::vector<ClassPixels>& classes, const PermutationBudget& budget = {}) {
  std::vector<MaterialClass> all;
  for (const ClassPixels& c : classes) all.push_back(c.materialClass);
  PermutationPlan plan(budget, kAllTextures, all);
  plan.add(classes);
  std::vector<Permutation> permutations;
  for (const MaterialClass& c : all) permutations.push_back(plan.of(c));
  return permutations;
}

std::vector<ClassPixels> makeClasses(std::uint32_t count, std::uint64_t pixels) {
  std::vector<ClassPixels> classes;
  for (std::uint32_t i = 0; i < count; ++i) classes.push_back({{i, i % 8}, pixels + i});
  return classes;
}

void expectServes(const Permutation& permutation, const MaterialClass& c) {
  EXPECT_EQ(permutation.textures & c.textures, c.textures);
  constexpr std::uint32_t kSlots = (1u << kSlotCount) - 1;
  EXPECT_TRUE((permutation.textures & kSlots) == c.textures || (permutation.textures & kTexturesVary) != 0);
  EXPECT_EQ(permutation.mayFeatures & c.features, c.features);
  EXPECT_EQ(permutation.mustFeatures & ~c.features, 0u) << "a feature that the class lacks must not be compiled in";
}

TEST(Permutations, AreExactForASingleClassHoweverSmall) {
  EXPECT_EQ(planAll({{{5, kFeatureNonmetal}, kSmall}})[0], (Permutation{5, kFeatureNonmetal, kFeatureNonmetal}));
}

TEST(Permutations, MergeClassesWhoseSavingDoesNotPayForTheCompilation) {
  const auto plan = planAll({{{1, kFeatureNonmetal}, kSmall}, {{2, 0}, kSmall}});
  EXPECT_EQ(plan[0], plan[1]);
  EXPECT_EQ(plan[0], (Permutation{3 | kTexturesVary, kFeatureNonmetal, 0}));
}

TEST(Permutations, AskForTexturesWhereTheirMaterialsDiffer) {
  const MaterialClass both{3, 0}, one{1, 0}, same{3, kFeatureUnlit};
  EXPECT_EQ(planAll({{both, kSmall}, {same, kSmall}})[0], (Permutation{3, kFeatureUnlit, 0})) << "all have the same";
  EXPECT_EQ(planAll({{both, kBig}})[0], (Permutation{3, 0, 0}));
  // What is not worth a permutation of its own takes a larger one, which then asks, also where it is seen later.
  const auto plan = planAll({{both, kBig}, {one, kSmall}});
  EXPECT_EQ(plan[0], (Permutation{3 | kTexturesVary, 0, 0}));
  EXPECT_EQ(plan[1], plan[0]);
  EXPECT_EQ(planAll({{both, kBig}, {one, kBig}}), (std::vector<Permutation>{{3, 0, 0}, {1, 0, 0}}));
  EXPECT_EQ(planAll({{both, kBig}, {{4, 0}, kSmall}}), (std::vector<Permutation>{{3, 0, 0}, {4, 0, 0}}))
      << "it has no code for the other";
  for (const MaterialClass& later :
       {one, MaterialClass{3 | kTransformedUvs, 0}, MaterialClass{3 | kOcclusionApart, 0}}) {
    PermutationPlan views({}, kAllTextures, {both, later});
    views.add({{both, kBig}});
    views.add({{later, kSmall}});
    EXPECT_EQ(views.of(later), views.of(both));
    EXPECT_EQ(views.of(both), (Permutation{later == one ? 3 | kTexturesVary : later.textures, 0, 0}));
  }
}

TEST(Permutations, OfSmallClassesAreRightForThoseSeenLater) {
  const MaterialClass both{3, 0}, one{1 | kTransformedUvs, 0};
  PermutationPlan plan({}, kAllTextures, {both, one});
  plan.add({{both, kSmall}});
  plan.add({{one, kSmall}});
  EXPECT_EQ(plan.of(one), plan.of(both));
  EXPECT_EQ(plan.of(both), (Permutation{3 | kTexturesVary | kTransformedUvs, 0, 0}));
}

TEST(Permutations, OfClassesThatReadOtherwiseAreRightForEach) {
  const auto plan = planAll({{{3, 0}, kBig + 1}, {{3 | kTransformedUvs, 0}, kBig}});
  EXPECT_EQ(plan[0], (Permutation{3, 0, 0}));
  EXPECT_EQ(plan[1], (Permutation{3 | kTransformedUvs, 0, 0}));
  // Where all scenes share one for the rest, nothing is widened for it.
  EXPECT_EQ(planAll({{{3, 0}, kBig}, {{1, 0}, kSmall}}, {.own = 2, .shares = true})[0], (Permutation{3, 0, 0}));
}

TEST(Permutations, TransformUvsWhereAMaterialDoes) {
  const auto plan = planAll({{{1 | kTransformedUvs, 0}, kSmall}, {{1, kFeatureUnlit}, kSmall}});
  EXPECT_EQ(plan[0], (Permutation{1 | kTransformedUvs, kFeatureUnlit, 0}));
  EXPECT_EQ(plan[1], plan[0]);
  EXPECT_EQ(everyScenePermutation(0).textures, kTransformedUvs | kOcclusionApart | kTexturesVary)
      << "any scene's materials";
}

TEST(Permutations, SplitOffAClassWhoseSavingPaysForTheCompilation) {
  // The rule of docs/design.md 7b: pixels x saving against the time of compiling.
  const auto enough = static_cast<std::uint64_t>(kPermutationCostMs * 1e6 / kPermutationSavingNsPerPixel);
  for (const bool pays : {true, false}) {
    const auto plan = planAll({{{1, kFeatureNonmetal}, kSmall}, {{2, 0}, pays ? enough + 1 : enough}});
    EXPECT_EQ(plan[1], pays ? (Permutation{2, 0, 0}) : (Permutation{3 | kTexturesVary, kFeatureNonmetal, 0}));
    EXPECT_EQ(plan[0], pays ? (Permutation{1, kFeatureNonmetal, kFeatureNonmetal}) : plan[1]);
  }
}

TEST(Permutations, AreAtMostEightAndServeEveryClass) {
  for (const std::uint64_t pixels : {kSmall, kBig}) {
    const std::vector<ClassPixels> classes = makeClasses(30, pixels);
    const auto plan = planAll(classes);
    EXPECT_EQ(std::set<Permutation>(plan.begin(), plan.end()).size(), pixels == kBig ? kMaxPermutations : 1);
    for (std::size_t i = 0; i < classes.size(); ++i) expectServes(plan[i], classes[i].materialClass);
  }
}

TEST(Permutations, AreMadeForWhatIsSeenAndAtMostEightWhateverIsSeenLater) {
  for (const std::uint64_t pixels : {kSmall, kBig}) {
    const std::vector<ClassPixels> classes = makeClasses(30, pixels);
    std::vector<MaterialClass> all;
    for (const ClassPixels& c : classes) all.push_back(c.materialClass);
    PermutationPlan plan({}, kAllTextures, all);
    std::set<Permutation> made;
    for (const ClassPixels& c : classes) {
      if (made.size() + 1 < kMaxPermutations && pixels == kBig) {
        EXPECT_FALSE(plan.has(c.materialClass)) << "nothing shows it yet";
      }
      plan.add({c});
      made.insert(plan.of(c.materialClass));
      expectServes(plan.of(c.materialClass), c.materialClass);
    }
    EXPECT_LE(made.size(), kMaxPermutations);
    EXPECT_EQ(plan.of(classes[0].materialClass), (Permutation{0, 0, 0})) << "the first was alone";
  }
}

TEST(Permutations, OfASceneWithoutItsOwnAreThatOfEveryScene) {
  const std::vector<ClassPixels> classes = makeClasses(30, kBig);
  const Permutation every = everyScenePermutation(kAllTextures);
  const auto none = planAll(classes, {.own = 0, .shares = true}), two = planAll(classes, {.own = 2, .shares = true});
  for (std::size_t i = 0; i < classes.size(); ++i) {
    EXPECT_EQ(none[i], every);
    expectServes(none[i], classes[i].materialClass);
    EXPECT_EQ(two[i] == every, i < 28) << "the two largest have their own";
  }
  EXPECT_EQ(planAll({{{5, 0}, kSmall}}, {.own = 2, .shares = true})[0], every) << "it does not pay";
}

TEST(Permutations, OfASceneWithLobesAreItsOwn) {
  const PermutationBudget alone{}, among{.own = 0, .shares = true}, large{.own = 3, .shares = true};
  EXPECT_EQ(alone.withLobes(), alone);
  EXPECT_EQ(among.withLobes(), (PermutationBudget{.own = 2}));
  EXPECT_EQ(large.withLobes(), (PermutationBudget{.own = 3}));
}

TEST(Permutations, OfARunAreEightHoweverManyScenesItHas) {
  EXPECT_EQ(shareOf(0, 1), PermutationBudget{});
  for (const std::size_t scenes : {2u, 3u, 7u, 8u, 9u, 100u}) {
    const bool shares = scenes > kMaxPermutations;
    std::size_t own = 0;
    for (std::size_t i = 0; i < scenes; ++i) {
      EXPECT_EQ(shareOf(i, scenes).shares, shares);
      EXPECT_GE(shareOf(i, scenes).own, kMaxPermutations / scenes) << "else it has none";
      own += shareOf(i, scenes).own;
    }
    EXPECT_EQ(own + (shares ? 1 : 0), kMaxPermutations) << scenes;
  }
}

TEST(Permutations, AreSaidInWords) {
  EXPECT_EQ(describeTextures(0), "none");
  EXPECT_EQ(describeTextures(1u << kSlotBaseColor | 1u << kSlotNormal | 1u << kSlotSpecularColor | kNormalVariance),
            "base colour, normal, specular colour, spread of normals");
  EXPECT_EQ(describeFeatures({0, 0, 0}), "none");
  EXPECT_EQ(describeFeatures({0, kFeatureNonmetal | kFeatureBlend, kFeatureBlend}), "some nonmetal, blended");
  EXPECT_EQ(describeFeatures({0, kFeatureUnlit, kFeatureUnlit}), "unlit");
  EXPECT_EQ(describeTextures(kCoatTextures), "coat, coat roughness, coat normal");
  EXPECT_EQ(describeTextures(kSheenTextures), "sheen colour, sheen roughness");
  EXPECT_EQ(describeTextures(kAnisotropyTextures | kIridescenceTextures), "anisotropy, iridescence, film thickness");
  EXPECT_EQ(describeFeatures({0, kFeatureCoat | kFeatureSheen, kFeatureSheen}), "some coat, sheen");
  EXPECT_EQ(describeFeatures({0, kFeatureAnisotropy | kFeatureIridescence, kFeatureIridescence}),
            "some anisotropy, iridescence");
}

TEST(Permutations, OfEverySceneHaveNoLobes) {
  const std::uint32_t base = (1u << kSlotCount) - 1 - kLobeTextures;
  EXPECT_EQ(everyScenePermutation(base | kLobeTextures), everyScenePermutation(base)) << "one is all scenes'";
  EXPECT_EQ(everyScenePermutation(base).mayFeatures & kFeatureLobes, 0u);
}

} // namespace
} // namespace parity::gpu
