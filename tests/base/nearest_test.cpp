// Edit distances by known answers, and the name that a user is told.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "base/text/nearest.h"

namespace parity::base {
namespace {

TEST(EditDistance, KnownAnswers) {
  EXPECT_EQ(editDistance("", ""), 0u);
  EXPECT_EQ(editDistance("abc", ""), 3u);
  EXPECT_EQ(editDistance("", "abc"), 3u);
  EXPECT_EQ(editDistance("kitten", "sitting"), 3u); // Levenshtein's textbook pair
  EXPECT_EQ(editDistance("ca", "abc"), 3u);         // optimal string alignment; full Damerau-Levenshtein gives 2
  EXPECT_EQ(editDistance("wran", "warn"), 1u);      // a swap is one edit
  EXPECT_EQ(editDistance("FLIP.Mean", "flip.mean"), 0u);
}

TEST(EditDistance, IsSymmetric) {
  for (const auto& [a, b] : {std::pair{"metric", "metrics"}, {"sunday", "saturday"}, {"abcd", "badc"}})
    EXPECT_EQ(editDistance(a, b), editDistance(b, a));
}

TEST(EditDistance, HostileLengthsAreCut) {
  EXPECT_EQ(editDistance(std::string(1 << 20, 'a'), std::string(1 << 20, 'b')), 256u);
}

TEST(NearestName, FindsTheLeastDistanceAndTheFirstOfEquals) {
  constexpr std::array<std::string_view, 4> kKnown = {"metric", "region", "warn", "fail"};
  EXPECT_EQ(nearestName("wran", kKnown), "warn");
  EXPECT_EQ(nearestName("Metrics", kKnown), "metric");
  EXPECT_EQ(nearestName("region", kKnown), "region");
  EXPECT_EQ(nearestName("", kKnown), "warn"); // 4 inserts for warn and for fail
  EXPECT_EQ(nearestName("x", {}), "");
}

TEST(NearestName, IsProposedOnlyWhereItIsNear) {
  constexpr std::array<std::string_view, 3> kKnown = {"flip", "rmse", "psnr"};
  EXPECT_EQ(describeNearest("flop", kKnown), "did you mean 'flip'?");
  EXPECT_EQ(describeNearest("rsme", kKnown, "builtin:"), "did you mean 'builtin:rmse'?");
  EXPECT_EQ(describeNearest("nope", kKnown), "known: flip, rmse, psnr") << "3 of 4 letters differ from rmse";
  EXPECT_EQ(describeNearest("nope", kKnown, "builtin:"), "known: builtin:flip, builtin:rmse, builtin:psnr");
  EXPECT_EQ(describeNearest("", {}), "known:");
}

TEST(DescribeNearest, AsksOrListsTheFirstNames) {
  constexpr std::array<std::string_view, 3> kKnown = {"flip", "rmse", "psnr"};
  EXPECT_EQ(askNearest("flop", kKnown), "did you mean 'flip'?");
  EXPECT_EQ(askNearest("nope", kKnown), "");
  const std::vector<std::string_view> many(30, "name");
  const std::string list = describeNearest("x", many);
  EXPECT_TRUE(list.ends_with(", name and 6 more")) << list;
}

TEST(DescribeNearest, OfAGlobTheNameThatNearlyMatches) {
  constexpr std::array<std::string_view, 3> kMaterials = {"metal 0.3", "gold", "plaster"};
  EXPECT_EQ(describeNearestToGlob("metl*", kMaterials), "did you mean 'metal 0.3'?");
  EXPECT_EQ(describeNearestToGlob("*platser", kMaterials), "did you mean 'plaster'?");
  EXPECT_EQ(describeNearestToGlob("[gh]old?", kMaterials), "did you mean 'gold'?");
  EXPECT_EQ(describeNearestToGlob("Gold", kMaterials), "did you mean 'gold'?")
      << "globs tell letters of either case apart";
  EXPECT_EQ(describeNearestToGlob("glod", kMaterials), "did you mean 'gold'?");
  EXPECT_EQ(describeNearestToGlob("zz*", kMaterials), "known: metal 0.3, gold, plaster");
  EXPECT_EQ(describeNearestToGlob("*", {}), "known:");
}

} // namespace
} // namespace parity::base
