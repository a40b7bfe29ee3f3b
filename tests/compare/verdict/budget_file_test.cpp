// Budget files: what is read, and that every mistake is one clear line with file, line, key and the nearest known name.
#include <gtest/gtest.h>

#include "base/error.h"
#include "base/expect_error.h"
#include "base/file.h"
#include "base/image/image.h"
#include "base/temp_folder.h"
#include "compare/verdict/budget.h"

namespace parity::compare {
namespace {

Budgets load(const std::string& text) {
  const base::TempFolder folder;
  base::writeText(folder / "b.toml", text);
  return loadBudgets(folder / "b.toml");
}

void expectRefusal(const std::string& text, const std::string& line, const std::string& reason) {
  base::expectError([&] { load(text); }, "b.toml: " + line, reason);
}

const std::string kCheck = R"(checks = [ { metric = "flip.mean", warn = 0.1, fail = 0.2 } ]
)";

TEST(BudgetFile, TheShippedExampleIsReadAsItReads) {
  const Budgets budgets = loadBudgets(PARITY_SOURCE_DIR "/compare/verdict/budgets.example.toml");
  ASSERT_EQ(budgets.materials.size(), 4u); // three of its own and the built-in one
  ASSERT_EQ(budgets.wholes.size(), 2u);

  const BudgetRule* hero = findMaterialRule(budgets, "any", "The Hero face");
  ASSERT_EQ(hero, &budgets.materials[0]);
  EXPECT_TRUE(hero->requireSeen);
  EXPECT_EQ(hero->minPixels, 200u);
  EXPECT_EQ(hero->owner, "characters");
  EXPECT_FALSE(hero->reason.empty());
  EXPECT_EQ(hero->origin.find("budgets.example.toml, line "), 0u);
  ASSERT_EQ(hero->checks.size(), 4u);
  EXPECT_EQ(hero->checks[0].statistic.name, "flip.mean");
  EXPECT_EQ(hero->checks[0].warn, 0.05);
  EXPECT_EQ(hero->checks[0].fail, 0.10);
  EXPECT_EQ(hero->checks[2].statistic.name, "psnr");
  EXPECT_EQ(hero->checks[2].warn, 32);
  EXPECT_EQ(hero->checks[3].statistic.better, Better::nearZero);
  ASSERT_EQ(hero->regress.size(), 1u);
  EXPECT_EQ(hero->regress[0].fail, 0.03);

  EXPECT_EQ(findMaterialRule(budgets, "MetalRoughSpheresNoTextures", "Metal 3"), &budgets.materials[1]);
  EXPECT_FALSE(budgets.materials[1].checks[1].warn);
  EXPECT_EQ(findMaterialRule(budgets, "Suzanne", "Metal 3"), &budgets.materials[2]);
}

TEST(BudgetFile, TheExampleShowsTheBuiltInLimits) {
  const Budgets budgets = loadBudgets(PARITY_SOURCE_DIR "/compare/verdict/budgets.example.toml");
  const auto expectSame = [](const BudgetRule& shown, const BudgetRule& real) {
    ASSERT_EQ(shown.checks.size(), real.checks.size());
    for (std::size_t i = 0; i < real.checks.size(); ++i) {
      EXPECT_EQ(shown.checks[i].statistic.name, real.checks[i].statistic.name);
      EXPECT_EQ(shown.checks[i].warn, real.checks[i].warn);
      EXPECT_EQ(shown.checks[i].fail, real.checks[i].fail);
    }
  };
  expectSame(budgets.materials[2], defaultBudgets().materials[0]);
  expectSame(budgets.wholes[0], defaultBudgets().wholes[0]);
}

// Every name that the example's head lists is one, and every figure there is, is listed.
TEST(BudgetFile, TheExampleListsTheFiguresThatThereAre) {
  const std::string text = base::readText(PARITY_SOURCE_DIR "/compare/verdict/budgets.example.toml");
  const std::size_t begin = text.find("#   metric  "), end = text.find("#   warn, fail  ");
  ASSERT_NE(end, std::string::npos);
  const std::string head = text.substr(begin, end - begin);
  for (const std::string& name : knownStatistics()) {
    if (name.starts_with("hdrflip.")) continue; // as hdrflip.*
    const std::string listed = name.substr(0, name.find("(X)"));
    EXPECT_NE(head.find(" " + listed), std::string::npos) << name;
  }
}

TEST(BudgetFile, ItsRulesAreToldInWords) {
  const std::string text = describeBudgets(loadBudgets(PARITY_SOURCE_DIR "/compare/verdict/budgets.example.toml"));
  for (const char* part : {": materials '*Hero*', must be visible in a view, at least 200 pixels, owner characters: "
                           "shown on the title screen",
                           "    mean FLIP (flip.mean): warn above 0.050, fail above 0.100\n",
                           "    PSNR (psnr): warn below 32.0 dB, fail below 28.0 dB\n",
                           "    regression of mean FLIP (flip.mean): warn above 0.010, fail above 0.030\n",
                           "materials '*[Mm]etal*' of scenes 'MetalRoughSpheres*'", "built-in: all materials\n",
                           "built-in: whole images\n"})
    EXPECT_NE(text.find(part), std::string::npos) << part << "\n" << text;
}

TEST(BudgetFile, WhatNoRuleMatchesIsJudgedByTheBuiltInOnes) {
  const Budgets budgets = load(std::string("[[material]]\nname = \"Hero\"\n") + kCheck);
  EXPECT_EQ(findMaterialRule(budgets, "s", "Hero")->origin, "b.toml, line 1");
  EXPECT_EQ(findMaterialRule(budgets, "s", "other")->origin, "built-in");
  EXPECT_EQ(findWholeRule(budgets, "s")->origin, "built-in");
}

TEST(BudgetFile, AnIntegerIsANumberToo) {
  EXPECT_EQ(load("[[whole]]\nchecks = [ { metric = \"rmse\", fail = 0 } ]").wholes[0].checks[0].fail, 0.0);
}

// Files of before name regions. Whatever they named, the one figure takes the place of it.
TEST(BudgetFile, RegionsAreRefusedWithWhatTakesTheirPlace) {
  for (const char* value : {"\"interior\"", "\"all\"", "\"interor\"", "3"})
    for (const char* list : {"checks", "regress"})
      for (const char* head : {"[[material]]\nname = \"*\"\n", "[[whole]]\nscene = \"*\"\n", "[preset.a]\n\n"})
        expectRefusal(std::string(head) + list + " = [ { metric = \"rmse\", region = " + value + ", warn = 0.1 } ]",
                      "line 3",
                      "'region' no longer exists: one figure over all pixels of a material judges it, without its "
                      "neighbours (docs/budgets.md); delete the key");
  expectRefusal("[[material]]\nname = \"*\"\nregion = \"all\"\n" + kCheck, "line 3", "unknown key 'region'");
}

TEST(BudgetFile, TheLeastSizeOfAMaterialIsReadAndToldInWords) {
  const auto rule = [](const std::string& line) {
    return load("[[material]]\nname = \"*\"\n" + line + "\n" + kCheck).materials[0];
  };
  EXPECT_EQ(rule("").minPixels, kDefaultMinPixels);
  EXPECT_EQ(kDefaultMinPixels, 64u);
  EXPECT_EQ(rule("min_pixels = 1").minPixels, 1u) << "judges whatever is seen";
  EXPECT_EQ(rule("min_pixels = 500").minPixels, 500u);
  EXPECT_EQ(rule("min_pixels = 268435456").minPixels, base::kMaxImagePixels) << "the largest picture there is";
  const auto tell = [](const BudgetRule& told) { return describeBudgets({{told}, {}}); };
  EXPECT_NE(tell(rule("min_pixels = 500")).find(", at least 500 pixels"), std::string::npos);
  EXPECT_EQ(tell(rule("")).find("pixels"), std::string::npos) << "the built-in size is not worth a word";
}

TEST(BudgetFile, LeastSizesThatMakeNoSenseAreRefused) {
  const auto refuse = [](const std::string& value, const std::string& reason) {
    expectRefusal("[[material]]\nname = \"*\"\nmin_pixels = " + value + "\n" + kCheck, "line 3", reason);
  };
  refuse("-1", "'min_pixels' is -1, outside the range 1..268435456");
  refuse("0", "'min_pixels' is 0, outside the range 1..268435456: 1 judges every material that is seen");
  refuse("268435457", "'min_pixels' is 268435457, outside the range");
  refuse("1000000000000", "'min_pixels' is 1000000000000, outside the range");
  refuse("1e12", "'min_pixels' must be a whole number");
  refuse("2.5", "'min_pixels' must be a whole number");
  refuse("\"64\"", "'min_pixels' must be a whole number");
  refuse("true", "'min_pixels' must be a whole number");
  refuse("nan", "'min_pixels' must be a whole number");
  expectRefusal("[[material]]\nname = \"*\"\nmin_pixel = 3\n" + kCheck, "line 3", "did you mean 'min_pixels'?");
  expectRefusal("[[whole]]\nmin_pixels = 3\n" + kCheck, "line 2", "unknown key 'min_pixels'");
}

TEST(BudgetFile, UnknownNamesAreRefusedWithTheNearestKnownOne) {
  const std::string head = "[[material]]\nname = \"*\"\n";
  expectRefusal("[[materials]]\nname = \"*\"\n", "line 1", "unknown key 'materials'; did you mean 'material'?");
  expectRefusal(head + "requires_seen = true\n" + kCheck, "line 3",
                "unknown key 'requires_seen'; did you mean 'require_seen'?");
  expectRefusal(head + "checks = [ { metric = \"flip.mean\", wran = 0.1 } ]", "line 3",
                "unknown key 'wran'; did you mean 'warn'?");
  expectRefusal(head + "checks = [\n  { metric = \"flip.meen\", warn = 0.1 },\n]", "line 4",
                "unknown metric 'flip.meen'; did you mean 'flip.mean'?");
  expectRefusal(head + "checks = [ { metric = \"flip\", warn = 0.1 } ]", "line 3",
                "unknown metric 'flip'; did you mean 'flip.mean'?");
  expectRefusal(head + "checks = [ { metric = \"flip.fraction_over(7)\", warn = 0.1 } ]", "line 3",
                "did you mean 'flip.fraction_over(X)'?");
  expectRefusal(head + "checks = [ { metric = \"vmaf\", warn = 0.1 } ]", "line 3",
                "unknown metric 'vmaf'; known: flip.");
  expectRefusal(head + "preset = \"stric\"", "line 3", "unknown preset 'stric'; did you mean 'strict'?");
  expectRefusal("[preset.a]\nreason = \"x\"\n", "line 2", "unknown key 'reason'");
  expectRefusal("[[whole]]\nname = \"*\"\n" + kCheck, "line 2", "unknown key 'name'");
}

TEST(BudgetFile, ListsThatWouldPassEverythingAreRefused) {
  expectRefusal("", "", "no rules");
  expectRefusal("material = []", "", "no rules");
  expectRefusal("[[material]]\nname = \"*\"\n", "line 1", "the rule needs 'checks' or 'regress'");
  expectRefusal("[[material]]\nname = \"*\"\nchecks = []\n", "line 3", "'checks' is empty");
  expectRefusal("[[material]]\nname = \"*\"\nchecks = [ { metric = \"rmse\" } ]\n", "line 3", "needs 'warn' or 'fail'");
  expectRefusal(std::string("[[material]]\n") + kCheck, "line 1", "no 'name'");
  expectRefusal("[[material]]\nname = \"\"\n" + kCheck, "line 2", "'name' is empty");
}

TEST(BudgetFile, LimitsThatMakeNoSenseAreRefused) {
  const auto refuse = [](const std::string& check, const std::string& reason) {
    expectRefusal("[[material]]\nname = \"*\"\nchecks = [ { " + check + " } ]", "line 3", reason);
  };
  refuse(R"(metric = "rmse", warn = nan)", "not a finite number");
  refuse(R"(metric = "rmse", fail = inf)", "not a finite number");
  refuse(R"(metric = "rmse", warn = -0.1)", "outside the range 0..1");
  refuse(R"(metric = "flip.mean", warn = 10)", "outside the range 0..1");
  refuse(R"(metric = "psnr", warn = -1)", "outside the range 0..inf of psnr");
  refuse(R"(metric = "rmse", warn = "0.1")", "'warn' must be a number");
  refuse(R"(metric = "rmse", warn = true)", "'warn' must be a number");
  refuse(R"(metric = "rmse", warn = 0.2, fail = 0.1)", "'warn' (0.2) is above 'fail' (0.1)");
  refuse(R"(metric = "psnr", warn = 28, fail = 32)", "'warn' (28) is below 'fail' (32)");
  refuse(R"(metric = 7, warn = 1)", "'metric' must be a string");
  refuse(R"(warn = 1)", "no 'metric'");
  refuse(R"(metric = "rmse", warn = 0.1 }, { metric = "rmse", fail = 0.2)", "'rmse' is checked twice");
}

// At the end of the range nothing is beyond the limit: it would always pass.
TEST(BudgetFile, LimitsThatNothingCanBeBeyondAreRefused) {
  const std::string head = "[[material]]\nname = \"*\"\n";
  const auto refuse = [&](const std::string& figure, const std::string& limit, const std::string& list = "checks") {
    expectRefusal(head + list + " = [ { metric = \"" + figure + "\", " + limit + " } ]", "line 3", "would always pass");
  };
  for (const char* figure : {"flip.mean", "flip.max", "hdrflip.p95", "flip.fraction_over(0.1)", "rmse", "maxabs"}) {
    refuse(figure, "fail = 1");
    refuse(figure, "warn = 0.5, fail = 1.0");
    refuse(figure, "warn = 1", "regress");
  }
  refuse("psnr", "fail = 0");
  refuse("ssim.mean", "fail = -1");
  refuse("msssim", "warn = 0");
  refuse("bias.dl", "fail = 100");
  refuse("ssim.mean", "fail = 2", "regress");
  EXPECT_NO_THROW(load(head + "checks = [ { metric = \"flip.mean\", fail = 0.999999 } ]"));
  EXPECT_NO_THROW(load(head + "checks = [ { metric = \"psnr\", fail = 0.1 }, { metric = \"relmse\", fail = 1e9 } ]"));
  EXPECT_NO_THROW(load(head + "regress = [ { metric = \"ssim.mean\", fail = 1.5 } ]"));
}

TEST(BudgetFile, AnyFigureMayBeNamedAlsoWithAParameter) {
  const Budgets budgets = load(R"TOML([[material]]
name = "*"
checks = [ { metric = "flip.fraction_over(0.10)", fail = 0.05 }, { metric = "bias.ev", warn = 0.3 } ])TOML");
  EXPECT_EQ(budgets.materials[0].checks[0].statistic.name, "flip.fraction_over(0.1)");
  EXPECT_EQ(budgets.materials[0].checks[1].statistic.better, Better::nearZero);
}

TEST(BudgetFile, ARuleTakesThePresetThatItNamesAndItsOwnChecksGoFirst) {
  const Budgets budgets = load(R"([preset.hero]
checks = [ { metric = "flip.mean", warn = 0.05 }, { metric = "rmse", fail = 0.1 } ]
regress = [ { metric = "psnr", fail = 3 } ]
[[material]]
name = "Face"
preset = "hero"
checks = [ { metric = "flip.mean", warn = 0.08 } ]
[[material]]
name = "*"
preset = "strict"
[[whole]]
preset = "hero")");
  const BudgetRule& face = budgets.materials[0];
  ASSERT_EQ(face.checks.size(), 2u);
  EXPECT_EQ(face.checks[0].warn, 0.08) << "the rule's own limit stands in for the preset's";
  EXPECT_EQ(face.checks[1].statistic.name, "rmse");
  ASSERT_EQ(face.regress.size(), 1u);
  EXPECT_EQ(face.regress[0].fail, 3);
  EXPECT_EQ(budgets.materials[1].checks[0].fail, 0.10);
  ASSERT_EQ(budgets.wholes[0].checks.size(), 2u);
  EXPECT_EQ(budgets.wholes[0].checks[0].warn, 0.05);
  EXPECT_EQ(face.line, 4);
  EXPECT_TRUE(face.file.ends_with("b.toml"));
}

TEST(BudgetFile, PresetsThatMakeNoSenseAreRefused) {
  const std::string rule = "[[material]]\nname = \"*\"\n";
  expectRefusal("[preset.strict]\nchecks = [ { metric = \"rmse\", warn = 0.1 } ]\n" + rule, "line 1", "is built in");
  expectRefusal("[preset.a]\n" + rule + kCheck, "line 1", "preset 'a' needs 'checks' or 'regress'");
  expectRefusal("[preset.a]\nchecks = []\n" + rule + kCheck, "line 2", "'checks' is empty");
  expectRefusal("preset = 3\n" + rule + kCheck, "line 1", "'preset' must hold tables");
  expectRefusal("[preset]\na = 3\n" + rule + kCheck, "line 2", "'a' must be a table");
  expectRefusal(rule, "line 1", "the rule needs 'checks' or 'regress'");
  expectRefusal(rule + "preset = \"\"", "line 3", "'preset' is empty");
}

TEST(BudgetFile, RegressionsAreDistancesAndMayStandAlone) {
  const std::string head = "[[material]]\nname = \"*\"\n";
  const Budgets budgets = load(head + "regress = [ { metric = \"psnr\", warn = 1, fail = 3 } ]");
  EXPECT_TRUE(budgets.materials[0].checks.empty());
  EXPECT_EQ(budgets.materials[0].regress[0].warn, 1) << "worse by more than it: not a lower bound";
  expectRefusal(head + "regress = []", "line 3", "'regress' is empty");
  expectRefusal(head + "regress = [ { metric = \"psnr\", warn = 3, fail = 1 } ]", "line 3",
                "'warn' (3) is above 'fail' (1)");
  expectRefusal(head + "regress = [ { metric = \"flip.mean\", warn = -0.1 } ]", "line 3",
                "outside the range 0..1 of changes of flip.mean");
}

TEST(BudgetFile, ARuleThatCanNeverMatchIsRefused) {
  const std::string all = std::string("[[material]]\nname = \"*\"\n") + kCheck;
  const std::string hero = std::string("[[material]]\nname = \"Hero\"\n") + kCheck;
  expectRefusal(all + hero, "line 4", "the rule of line 1 already matches everything that this rule matches");
  expectRefusal(hero + hero, "line 4", "line 1");
  EXPECT_NO_THROW(load(hero + all));
  EXPECT_NO_THROW(load(std::string("[[material]]\nname = \"Hero\"\nscene = \"Title\"\n") + kCheck + hero));
}

TEST(BudgetFile, WrongShapesAreRefused) {
  expectRefusal("material = 3", "line 1", "'material' must be an array of tables");
  expectRefusal("[material]\nname = \"*\"", "line 1", "[[material]]");
  expectRefusal("material = [1]", "line 1", "not a table");
  expectRefusal("[[material]]\nname = \"*\"\nchecks = { metric = \"rmse\" }", "line 3", "array of tables");
  expectRefusal(std::string("[[material]]\nname = \"*\"\nrequire_seen = 1\n") + kCheck, "line 3", "true or false");
}

TEST(BudgetFile, SyntaxErrorsAndMissingFilesAreOneLine) {
  expectRefusal("[[material]]\nname = \n", "line 2", "");
  expectRefusal("[[material]]\nname = \"a\"\nname = \"b\"\n", "line 3", "");
  expectRefusal("[[material]]\nname = \"\xff\"\n", "line 2", "");
  const base::TempFolder folder;
  base::expectError([&] { loadBudgets(folder / "none.toml"); }, "none.toml", "");
}

TEST(BudgetFile, WhatIsAcceptedIsNamedAndHasAReason) {
  const Budgets budgets = load(R"([[material]]
name = "a"
reason = "known"
accept = ["not seen", "non-finite"]
max_non_finite = 5
preset = "default"
[[material]]
name = "b"
reason = "any"
accept = ["no limit"]
[[whole]]
reason = "night"
accept = ["clipped"]
preset = "default"
)");
  EXPECT_EQ(budgets.materials[0].accept, (std::vector{Accept::notSeen, Accept::nonFinite}));
  EXPECT_EQ(budgets.materials[0].maxNonFinite, std::uint64_t{5});
  EXPECT_TRUE(budgets.materials[1].checks.empty());
  EXPECT_EQ(budgets.wholes[0].accept, std::vector{Accept::clipped});
  const std::string text = describeBudgets(budgets);
  EXPECT_NE(text.find("    accepts: non-finite, at most 5 pixels in a view\n"), std::string::npos) << text;
  for (const Accept each : kAccepts) EXPECT_EQ(acceptByName(nameOf(each)), each);
}

TEST(BudgetFile, RefusesWhatCannotBeAccepted) {
  const std::string rule = "[[material]]\nname = \"*\"\nreason = \"r\"\n";
  const auto accepting = [&](const std::string& list) { return rule + "accept = " + list + "\n"; };
  expectRefusal(accepting("[\"not sen\"]") + kCheck, "line 4", "does not know 'not sen'");
  expectRefusal(accepting("[]") + kCheck, "line 4", "must be a list");
  expectRefusal(accepting("\"not seen\"") + kCheck, "line 4", "must be a list");
  expectRefusal(accepting("[1]") + kCheck, "line 4", "is not a string");
  expectRefusal(accepting("[\"clipped\", \"clipped\"]") + kCheck, "line 4", "accepted twice");
  expectRefusal(accepting("[\"clipped\"]"), "line 1", "needs 'checks' or 'regress'");
  expectRefusal(accepting("[\"no limit\"]") + kCheck, "line 5", "contradicts 'checks'");
  expectRefusal(accepting("[\"non-finite\"]") + kCheck, "line 4", "needs 'max_non_finite'");
  expectRefusal(rule + "max_non_finite = 3\n" + kCheck, "line 4", "needs 'accept'");
  expectRefusal(accepting("[\"non-finite\"]") + "max_non_finite = 0\n" + kCheck, "line 5", "outside the range 1..");
  expectRefusal(accepting("[\"not seen\"]") + "require_seen = true\n" + kCheck, "line 4", "contradicts 'require_seen'");
  expectRefusal("[[material]]\nname = \"*\"\naccept = [\"clipped\"]\n" + kCheck, "line 3", "needs a 'reason'");
  expectRefusal("[[whole]]\nreason = \"r\"\naccept = [\"too small\"]\n" + kCheck, "line 3",
                "whole images are never 'too small'");
}

} // namespace
} // namespace parity::compare
