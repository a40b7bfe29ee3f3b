// One set for many scenes, against every set tried by hand.
#include "study/explain/team.h"

#include <gtest/gtest.h>

namespace parity::explain {
namespace {

Switch switchOf(const char* name) {
  return {.name = name, .value = "on", .words = {}, .approximation = {}, .needs = {}, .knobs = {}};
}

MaterialExplanation materialOf(const std::vector<double>& flip, std::size_t switches, std::int64_t operations) {
  MaterialExplanation m;
  m.limit = 0.1;
  m.flip = flip;
  m.best.push_back({0, flip[0], {300, 2}, {}});
  for (std::size_t i = 0; i < switches; ++i)
    m.alone.push_back(
        {SwitchMask{1} << i, flip[SwitchMask{1} << i], {300 + operations * static_cast<std::int64_t>(i + 1), 2}, {}});
  m.worth = shapleyValues(flip, switches);
  return m;
}

std::vector<SceneExplanation> scenes() {
  SceneExplanation a, b, broken;
  a.switches = {switchOf("x"), switchOf("y")};
  a.materials = {materialOf({0.3, 0.05, 0.3, 0.05}, 2, 10), materialOf({0.3, 0.3, 0.05, 0.05}, 2, 10)};
  b.switches = {switchOf("y")}; // x does nothing there
  b.materials = {materialOf({0.2, 0.08}, 1, 10), materialOf({0.05, 0.05}, 1, 10)};
  broken.failure = "no such file";
  return {a, b, broken};
}

TEST(Team, FindsTheSetOfEachSizeWithMostWithinTheirLimits) {
  const TeamView team = teamViewOf(scenes());
  EXPECT_EQ(team.materials, 4u);
  ASSERT_EQ(team.sets.size(), 3u);
  EXPECT_TRUE(team.sets[0].switches.empty());
  EXPECT_EQ(team.sets[0].within, 1u);
  EXPECT_NEAR(team.sets[0].meanFlip, 0.85 / 4, 1e-12);
  EXPECT_EQ(team.sets[0].operations, 0);
  EXPECT_EQ(team.sets[1].switches, std::vector<std::string>{"y=on"}) << "it repairs two, x one";
  EXPECT_EQ(team.sets[1].within, 3u);
  EXPECT_NEAR(team.sets[1].operations, (20 + 20 + 10 + 10) / 4.0, 1e-12);
  EXPECT_EQ(team.sets[2].within, 4u);
  EXPECT_NEAR(team.sets[2].meanFlip, (0.05 + 0.05 + 0.08 + 0.05) / 4, 1e-12);
}

TEST(Team, OfNothingIsEmpty) {
  EXPECT_EQ(teamViewOf({}).materials, 0u);
  EXPECT_TRUE(teamViewOf({scenes()[2]}).sets.empty());
}

} // namespace
} // namespace parity::explain
