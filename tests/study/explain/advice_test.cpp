// What is advised, and in which words: of materials written by hand.
#include "study/explain/advice.h"

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

const std::vector<Switch> kSwitches = {
    {.name = "formulas", .value = "refit", .words = {}, .approximation = {}, .needs = {}, .knobs = {}},
    {.name = "sky-sh", .value = "9", .words = {}, .approximation = {}, .needs = {}, .knobs = {}},
    {.name = "mobile-fully-rough",
     .value = "on",
     .words = {},
     .approximation = {},
     .needs = {},
     .knobs = {},
     .cheapens = true}};

// Two switches and one that cheapens. flip: of the eight sets. Each switch costs 9 operations more, the last 100 and a
// fetch fewer.
MaterialExplanation materialOf(const std::vector<double>& flip, double limit) {
  const auto costOf = [](SwitchMask mask) {
    return Cost{300 + 9 * static_cast<int>(mask & 1) + 9 * static_cast<int>(mask >> 1 & 1) -
                    100 * static_cast<int>(mask >> 2 & 1),
                2 - static_cast<int>(mask >> 2 & 1)};
  };
  MaterialExplanation m;
  m.name = "gold";
  m.limit = limit;
  m.flip = flip;
  const auto outcomeOf = [&](SwitchMask mask) { return SetOutcome{mask, flip[mask], costOf(mask), {}}; };
  for (const SwitchMask mask : bestOfEachSize(std::span(flip).first(4), 2)) m.best.push_back(outcomeOf(mask));
  for (const SwitchMask mask : {1u, 2u, 4u}) m.alone.push_back(outcomeOf(mask));
  m.repair = chooseRepair(m);
  m.cheaper.push_back(outcomeOf(m.repair | 4));
  const std::vector<SwitchMask> advised = chooseAdvice(m);
  for (auto* sets : {&m.best, &m.alone, &m.cheaper})
    for (SetOutcome& set : *sets)
      if (std::ranges::count(advised, set.mask) > 0) set.rendered = set.flip;
  return m;
}

TEST(Advice, IsTheSmallestSetWithinTheLimitAndNamesWhatHurtsAlone) {
  const MaterialExplanation m = materialOf({0.144, 0.178, 0.12, 0.028, 0.5, 0.5, 0.5, 0.5}, 0.1);
  EXPECT_EQ(m.repair, 3u);
  EXPECT_EQ(sentencesOf(m, kSwitches),
            (std::vector<std::string>{
                "formulas=refit + sky-sh=9: mean FLIP 0.028 instead of 0.144, with 6 % more operations; "
                "formulas=refit alone makes it worse (0.178)."}));
  EXPECT_EQ(materialOf({0.144, 0.09, 0.12, 0.028, 0.5, 0.5, 0.5, 0.5}, 0.1).repair, 1u) << "one is enough";
}

TEST(Advice, SaysWhereNoSetIsEnoughAndWhereNoneHelps) {
  const MaterialExplanation far = materialOf({0.6, 0.3, 0.59, 0.29, 0.7, 0.7, 0.7, 0.7}, 0.1);
  EXPECT_EQ(far.repair, 1u) << "it gains nine tenths of what there is to gain";
  EXPECT_EQ(sentencesOf(far, kSwitches).at(0),
            "formulas=refit: mean FLIP 0.300 instead of 0.600, with 9 operations more; no set brings it below 0.1.");
  const MaterialExplanation stuck = materialOf({0.6, 0.6, 0.7, 0.6, 0.9, 0.9, 0.9, 0.9}, 0.1);
  EXPECT_EQ(stuck.repair, 0u);
  EXPECT_EQ(sentencesOf(stuck, kSwitches), std::vector<std::string>{"None of the switches brings it nearer."});
}

TEST(Advice, SavesOnlyWhereItIsHarmless) {
  const MaterialExplanation rubber = materialOf({0.05, 0.04, 0.05, 0.03, 0.054, 0.1, 0.1, 0.1}, 0.1);
  EXPECT_EQ(rubber.repair, 0u) << "it is within its limit";
  EXPECT_EQ(
      sentencesOf(rubber, kSwitches),
      std::vector<std::string>{"mobile-fully-rough=on: mean FLIP 0.054 instead of 0.050, with 33 % fewer operations, "
                               "1 fetch fewer."});
  EXPECT_TRUE(chooseAdvice(materialOf({0.05, 0.04, 0.05, 0.03, 0.061, 0.1, 0.1, 0.1}, 0.1)).empty()) << "rises by .011";
  EXPECT_TRUE(chooseAdvice(materialOf({0.095, 0.04, 0.05, 0.03, 0.104, 0.1, 0.1, 0.1}, 0.1)).empty())
      << "beyond the limit";
  // With the repair it is judged by what the repair gives.
  const MaterialExplanation both = materialOf({0.3, 0.05, 0.3, 0.05, 0.3, 0.055, 0.3, 0.3}, 0.1);
  EXPECT_EQ(chooseAdvice(both), (std::vector<SwitchMask>{1, 5}));
}

TEST(Advice, NamesThePartThatHoldsTheError) {
  MaterialExplanation m = materialOf({0.3, 0.05, 0.3, 0.05, 0.5, 0.5, 0.5, 0.5}, 0.1);
  m.ranges = {{"roughness", 0, 0.1, 0.06, 0.61}, {"roughness", 0.1, 0.2, 0.94, 0.39}, {"N.V", 0, 1, 1, 1}};
  EXPECT_EQ(sentencesOf(m, kSwitches).back(), "61 % of its FLIP lies where roughness is below 0.1: 6 % of its pixels.");
}

TEST(Advice, CostsAreSaidInCountsOrPerCent) {
  EXPECT_EQ(describeCost({309, 2}, {300, 2}), "9 operations more");
  EXPECT_EQ(describeCost({200, 1}, {300, 2}), "33 % fewer operations, 1 fetch fewer");
  EXPECT_EQ(describeCost({330, 4}, {300, 2}), "10 % more operations, 2 fetches more");
  EXPECT_EQ(describeCost({300, 2}, {300, 2}), "the same cost");
}

} // namespace
} // namespace parity::explain
