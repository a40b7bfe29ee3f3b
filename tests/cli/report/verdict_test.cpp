// Baselines, annotations and parity budget, as a user meets them.
#include "cli/checks.h"

namespace parity::tests {
namespace {

class VerdictTest : public RenderingTest {
protected:
  RunResult report(const std::string& folder, const std::vector<std::string>& more = {}) const {
    return runParity(join({{"report", "builtin:furnace", "-o", path(folder)}, kSmall, more}));
  }
};

TEST_F(VerdictTest, AnUnchangedRunHasChangesOfZeroAndNoRegression) {
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "*"
regress = [ { metric = "flip.mean", fail = 0 }, { metric = "psnr", fail = 0 } ]
[[whole]]
checks = [ { metric = "flip.mean", fail = 0.999 } ])");
  expectRefused(report("old", {"--budgets", budgets}), 4, {"b.toml", "limits only regressions", "--baseline"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "old")) << "refused before anything is rendered";
  ASSERT_NE(report("old").exitCode, 4);
  EXPECT_TRUE(exitedWith(0, report("new", {"--budgets", budgets, "--baseline", path("old")})));
  const nlohmann::json now = readReport(m_folder / "new");
  EXPECT_EQ(now["baseline"]["source"], "report.json");
  EXPECT_EQ(now["baseline"]["gone"].size(), 0u);
  for (const nlohmann::json& material : now["scenes"][0]["views"][0]["materials"]) {
    EXPECT_EQ(material["baseline"]["new"], false);
    EXPECT_EQ(material["baseline"]["changes"]["flip.mean"], 0);
  }
  // The report's own folder may hold the baseline: it is read first.
  EXPECT_TRUE(exitedWith(0, report("new", {"--budgets", budgets, "--baseline", path("new")})));
}

TEST_F(VerdictTest, ARegressionFailsWithTheFigureInWords) {
  ASSERT_NE(report("old").exitCode, 4);
  nlohmann::json old = readReport(m_folder / "old");
  for (nlohmann::json& material : old["scenes"][0]["views"][0]["materials"])
    if (material["figures"].is_object()) material["figures"]["metrics"]["flip.mean"] = -1;
  const std::string baseline = write("old.json", old.dump());
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "*"
regress = [ { metric = "flip.mean", warn = 0.1, fail = 0.5 } ])");
  const RunResult result =
      runParity(join({{"diff", "builtin:furnace", "--budgets", budgets, "--baseline", baseline}, kSmall}));
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_TRUE(contains(result.out, "worse than in the baseline, above 0.500")) << result.out;
}

TEST_F(VerdictTest, WhatIsGoneIsAWarning) {
  const std::string budgets = writeBudgets(m_folder, "fail = 0.999");
  ASSERT_TRUE(exitedWith(0, report("old", {"--budgets", budgets})));
  nlohmann::json old = readReport(m_folder / "old");
  nlohmann::json& materials = old["scenes"][0]["views"][0]["materials"];
  materials.push_back(materials[0]);
  materials.back()["name"] = "Lamp";
  const std::string baseline = write("old.json", old.dump());
  const RunResult result = report("new", {"--budgets", budgets, "--baseline", baseline, "--warn-exit"});
  EXPECT_TRUE(exitedWith(1, result));
  EXPECT_TRUE(exitedWith(0, report("same", {"--budgets", budgets, "--baseline", path("old"), "--warn-exit"})))
      << "nothing else warns";
  EXPECT_TRUE(contains(result.out, "gone: material 'Lamp'")) << result.out;
  EXPECT_TRUE(contains(readWholeFile(m_folder / "new" / "junit.xml"), "gone: material &#39;Lamp&#39;"));
}

TEST_F(VerdictTest, ABaselineThatCannotBeUsedIsRefusedBeforeAnythingIsRendered) {
  ASSERT_NE(report("old").exitCode, 4);
  const nlohmann::json old = readReport(m_folder / "old");
  expectRefused(report("new", {"--baseline", path("none.json")}), 4, {"none.json", "does not exist"});
  expectRefused(report("new", {"--baseline", write("broken.json", "{")}), 4, {"broken.json", "is not JSON"});
  nlohmann::json newer = old;
  newer["schema"] = 1000;
  expectRefused(report("new", {"--baseline", write("newer.json", newer.dump())}), 4,
                {"newer.json", "/schema", "a newer version"});
  nlohmann::json older = old; // of figures over interiors
  older["schema"] = 2;
  expectRefused(report("new", {"--baseline", write("older.json", older.dump())}), 4,
                {"older.json", "/schema", "an older version", "make the report again"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "new"));
}

TEST_F(VerdictTest, ABaselineWithNothingInCommonIsAnError) {
  ASSERT_NE(report("old").exitCode, 4);
  nlohmann::json old = readReport(m_folder / "old");
  old["scenes"][0]["name"] = "another";
  const RunResult result = report("new", {"--baseline", write("old.json", old.dump())});
  EXPECT_TRUE(exitedWith(4, result));
  EXPECT_TRUE(contains(result.err, "no material of this run is visible in the baseline")) << result.err;
  EXPECT_TRUE(contains(readWholeFile(m_folder / "new" / "junit.xml"),
                       "<error type=\"error\" message=\"no material of this run is visible in the baseline"));
}

TEST_F(VerdictTest, ARuleThatJudgesNothingIsAWarningInWords) {
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "Heroo"
preset = "strict"
[[material]]
name = "*"
checks = [ { metric = "flip.mean", fail = 0.999 } ])");
  const std::vector<std::string> diff = join({{"diff", "builtin:furnace", "--budgets", budgets}, kSmall});
  const RunResult result = runParity(diff);
  EXPECT_TRUE(contains(result.err, "b.toml: a rule judges nothing in this run: line 2 ('Heroo')")) << result.err;
  EXPECT_FALSE(contains(runParity(join({diff, {"--material", "*"}})).err, "judges nothing"))
      << "with --material nobody knows";
}

TEST_F(VerdictTest, AnnotationsPointAtTheRule) {
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "*"
owner = "lighting"
checks = [ { metric = "flip.max", fail = 0 } ])");
  RunOptions here;
  here.workingFolder = m_folder.path();
  const std::vector<std::string> diff =
      join({{"diff", "builtin:spheres", "--budgets", "b.toml", "--annotate", "github"}, kSmall});
  const RunResult result = runParity(diff, here);
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_TRUE(contains(result.out, "\n::error file=b.toml,line=2,title=parity%3A ")) << result.out;
  EXPECT_TRUE(contains(result.out, "%0AOwner: lighting\n")) << result.out;
  const RunResult json = runParity(join({diff, {"--json", "-"}}), here);
  EXPECT_TRUE(nlohmann::json::accept(json.out)) << "stdout is JSON alone";
  EXPECT_TRUE(contains(json.err, "::error file=b.toml,line=2")) << json.err;
  EXPECT_EQ(runParity({"diff", "builtin:spheres", "--annotate", "gitlab"}).exitCode, 64);
}

// Of eight equal lights the mobile path takes four: it has half of the light. None is so bright that pixels clip.
TEST_F(VerdictTest, TheTableSaysTheBiasInWords) {
  GltfFile quad = makeQuad();
  quad.material()["pbrMetallicRoughness"] = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
  quad.json["extensionsUsed"] = {"KHR_lights_punctual"};
  quad.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 1}}};
  for (int i = 0; i < 8; ++i) {
    quad.json["scenes"][0]["nodes"].push_back(quad.json["nodes"].size());
    quad.json["nodes"].push_back(
        {{"translation", {0.5, 0.5, 3}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
  }
  const RunResult result = runParity(join(
      {{"diff", writeGlb(m_folder, quad), "--background", "0,0,0", "--budgets", writeBudgets(m_folder, "fail = 0.999")},
       kSmall}));
  for (const std::string& line : linesOf(result.out))
    if (contains(line, "  paint ")) {
      EXPECT_TRUE(contains(line, "mobile is 1.0 EV darker")) << result.out;
    }
  EXPECT_TRUE(contains(result.out, "  paint ")) << result.out << result.err;
  const std::vector<std::string> lines = linesOf(result.out);
  EXPECT_TRUE(contains(lines.back() + lines[lines.size() - 2], "whole images: 1 pass")) << result.out;
}

// What is read stays: a report as JSON over the budgets that judged it would take the limits away.
TEST_F(VerdictTest, NoOutputOverwritesAnInput) {
  const std::string budgets = writeBudgets(m_folder, "fail = 0.999"), text = readWholeFile(budgets);
  ASSERT_TRUE(exitedWith(0, report("old", {"--budgets", budgets})));
  const std::string old = path("old/report.json"), oldText = readWholeFile(old);
  const std::string detour = (m_folder / "old" / ".." / std::filesystem::path(budgets).filename()).string();
  for (const char* command : {"report", "diff"}) {
    const std::vector<std::string> base = join(
        {{command, "builtin:furnace", "--budgets", budgets, "--baseline", path("old")},
         std::string(command) == "report" ? std::vector<std::string>{"-o", path("new")} : std::vector<std::string>{}});
    for (const std::string& target : {budgets, detour})
      expectRefused(runParity(join({base, {"--json", target}})), 64, {"--json", "would overwrite the budgets"});
    expectRefused(runParity(join({base, {"--json", old}})), 64, {"--json", "would overwrite the baseline"});
  }
  const std::string suite = write("suite.toml", "[[scene]]\nfile = \"builtin:furnace\"\n");
  expectRefused(runParity({"report", "--suite", suite, "-o", path("new"), "--json", suite}), 64,
                {"would overwrite the suite"});
  expectRefused(report("new", {"--json", path("new/index.html")}), 64, {"is also the file of -o"});
  expectRefused(runParity({"budget", "suggest", path("old"), "-o", old}), 64, {"would overwrite a report"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "new"));
  EXPECT_EQ(readWholeFile(budgets), text);
  EXPECT_EQ(readWholeFile(old), oldText);
}

TEST_F(VerdictTest, QuietPrintsErrorsAloneAndTheExitCodeIsTheVerdict) {
  const std::string budgets = writeBudgets(m_folder, "fail = 0");
  const RunResult result = report("out", {"-q", "--budgets", budgets, "--json", path("copy.json")});
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_EQ(result.out + result.err, "");
  EXPECT_EQ(readWholeFile(path("copy.json")), readWholeFile(m_folder / "out" / "report.json"));
  const RunResult diff = runParity(join({{"diff", "builtin:furnace", "-q", "--budgets", budgets}, kSmall}));
  EXPECT_TRUE(exitedWith(2, diff));
  EXPECT_EQ(diff.out + diff.err, "");
}

// The whole image of some materials is not that of all: held against it, it would be better or worse for no reason.
TEST_F(VerdictTest, WholeImagesOfOtherMaterialsDoNotRegress) {
  const std::string budgets = write("b.toml", R"(
[[material]]
name = "*"
checks = [ { metric = "flip.mean", fail = 0.999 } ]
[[whole]]
checks = [ { metric = "flip.mean", fail = 0.999 } ]
regress = [ { metric = "flip.mean", fail = 0 } ])");
  ASSERT_TRUE(exitedWith(0, report("old", {"--budgets", budgets})));
  const nlohmann::json old = readReport(m_folder / "old");
  const std::string material = old["scenes"][0]["views"][0]["materials"][10]["name"];
  const RunResult result = report("new", {"--budgets", budgets, "--baseline", path("old"), "--material", material});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_TRUE(contains(result.err, "materials was all, is " + material)) << result.err;
  const nlohmann::json whole = readReport(m_folder / "new")["scenes"][0]["views"][0]["whole"];
  EXPECT_EQ(whole["checks"][1]["verdict"], "not judged");
  EXPECT_EQ(whole["verdict"], "warn") << "its level was judged, and that it is not comparable is no pass";
}

TEST_F(VerdictTest, SuggestedBudgetsPassTheRunTheyCameFrom) {
  ASSERT_NE(report("old").exitCode, 4);
  const std::string budgets = path("suggested.toml");
  const RunResult result = runParity({"budget", "suggest", path("old"), path("old/report.json"), "-o", budgets});
  EXPECT_TRUE(exitedWith(0, result));
  EXPECT_EQ(result.out, "");
  EXPECT_TRUE(contains(readWholeFile(budgets), "# 1 run: flip.mean ")) << readWholeFile(budgets);
  EXPECT_TRUE(contains(result.err, "is the same run as " + path("old") + ", so it counts once")) << result.err;
  EXPECT_TRUE(exitedWith(0, report("new", {"--budgets", budgets, "--warn-exit"})));
  const RunResult checked = runParity({"budget", "check", budgets});
  EXPECT_TRUE(exitedWith(0, checked));
  EXPECT_TRUE(contains(checked.out, "suggested.toml, line ")) << checked.out;
  EXPECT_EQ(runParity({"budget", "suggest", path("old"), path("old")}).out.substr(0, 16), "# Budgets sugges");
}

TEST(BudgetCommand, RefusesWhatItCannotUse) {
  const TempFolder folder;
  writeFile(folder / "b.toml", "[[material]]\nname = \"*\"\nchecks = []\n");
  expectRefused(runParity({"budget", "check", (folder / "b.toml").string()}), 4, {"b.toml", "line 3", "is empty"});
  expectRefused(runParity({"budget", "check", (folder / "none.toml").string()}), 4, {"none.toml"});
  expectRefused(runParity({"budget", "suggest", (folder / "none.json").string()}), 4, {"none.json", "does not exist"});
  writeFile(folder / "list.json", "[]");
  expectRefused(runParity({"budget", "suggest", (folder / "list.json").string()}), 4,
                {"list.json", "is not an object"});
  for (const std::vector<std::string>& usage : {std::vector<std::string>{"budget"},
                                                {"budget", "suggest"},
                                                {"budget", "check"},
                                                {"budget", "suggset"},
                                                {"budget", "suggest", "x.json", "--margin", "-1"},
                                                {"budget", "suggest", "x.json", "--margin", "nan"},
                                                {"budget", "suggest", "x.json", "--metrics", "flip.meen"},
                                                {"budget", "suggest", "x.json", "--metrics", ","}})
    EXPECT_EQ(runParity(usage).exitCode, 64) << runParity(usage).commandLine << runParity(usage).err;
}

} // namespace
} // namespace parity::tests
