// --only: which globs mean which views.
#include <gtest/gtest.h>

#include "base/text/glob.h"
#include "report/sample_report.h"
#include "report/view_choice.h"

namespace parity::report {
namespace {

TEST(ViewChoice, ASceneAloneMeansAllOfItsViews) {
  EXPECT_TRUE(isChosen({"Lamp"}, "Lamp", "front"));
  EXPECT_TRUE(isChosen({"L*"}, "Lamp", "front"));
  EXPECT_FALSE(isChosen({"Lamp"}, "Lamp post", "front"));
  EXPECT_FALSE(isChosen({"front"}, "Lamp", "front"));
}

TEST(ViewChoice, SceneAndViewAreGlobsOfTheirOwn) {
  EXPECT_TRUE(isChosen({"Lamp/front"}, "Lamp", "front"));
  EXPECT_TRUE(isChosen({"*/front"}, "Lamp", "front"));
  EXPECT_FALSE(isChosen({"Lamp/back"}, "Lamp", "front"));
  EXPECT_FALSE(isChosen({"Lamp/"}, "Lamp", "front"));
  EXPECT_TRUE(isChosen({"Desk", "Lamp/fr?nt"}, "Lamp", "front")) << "any of them";
  EXPECT_TRUE(isChosen({}, "Lamp", "front")) << "no globs: all";
}

TEST(ViewChoice, NamesMayHoldASlash) {
  EXPECT_TRUE(isChosen({"a/b/c"}, "a/b", "c"));
  EXPECT_TRUE(isChosen({"a/b/c"}, "a", "b/c"));
  EXPECT_TRUE(isChosen({"a/b"}, "a/b", "c"));
  EXPECT_FALSE(isChosen({"a/b"}, "a", "c"));
}

TEST(ViewChoice, TheGlobOfANameMatchesItAndIsFitForATerminal) {
  std::vector<std::string> names = hostileNames();
  names.insert(names.end(), {"plain", "Gold [1]*?", "[a-z]", "tab\tand\nline", "##[group]"});
  for (const std::string& name : names) {
    const std::string glob = globOf(name);
    EXPECT_TRUE(base::matchesGlob(glob, name)) << glob;
    for (const char c : glob) EXPECT_FALSE(static_cast<unsigned char>(c) < 0x20) << glob;
  }
  EXPECT_EQ(globOf("Gold [1]*"), "Gold ?1]?");
  EXPECT_FALSE(base::matchesGlob(globOf("Gold [1]"), "Gold 1")) << "as a set it would";
}

} // namespace
} // namespace parity::report
