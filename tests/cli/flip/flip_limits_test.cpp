// parity flip judges by the limits it is given: pooled and pixelwise, each with its exit code and its reason in words.
#include "base/image/image_io.h"
#include "cli/flip/flip_pictures.h"

namespace parity::tests {
namespace {

// A picture, and one of which a block of 16x16 in 64x64 (6.25 % of the pixels) is much brighter.
class FlipLimits : public FolderTest {
protected:
  void SetUp() override {
    base::Image image = makePicture(64, 64);
    base::writeImage(m_folder / "a.exr", image);
    for (int y = 16; y < 32; ++y)
      for (int x = 16; x < 32; ++x)
        for (int c = 0; c < 3; ++c) image.at(x, y)[c] = 1;
    base::writeImage(m_folder / "b.exr", image);
  }

  RunResult flip(const std::vector<std::string>& more) const {
    return runParity(join({{"flip", path("a.exr"), path("b.exr")}, more}));
  }

  void expectVerdict(int code, const std::vector<std::string>& options, const std::string& words) const {
    const RunResult result = flip(options);
    EXPECT_TRUE(exitedWith(code, result));
    EXPECT_TRUE(contains(linesOf(result.out).back(), words)) << result.commandLine << "\n" << result.out;
  }
};

TEST_F(FlipLimits, WithoutAnyNothingIsJudgedAndThatIsSaid) { expectVerdict(0, {}, "no limits were given"); }

TEST_F(FlipLimits, PooledFigureIsHeldAgainstItsLimit) {
  expectVerdict(2, {"--metric", "flip.mean", "--fail", "0.02"}, "FAIL: mean FLIP");
  expectVerdict(0, {"--metric", "flip.mean", "--fail", "0.5"}, "pass");
  expectVerdict(0, {"--metric", "psnr", "--fail", "5"}, "pass");
  expectVerdict(2, {"--metric", "psnr", "--fail", "60"}, "is below");
  expectVerdict(0, {"--metric", "bias.ev", "--fail", "3"}, "pass");
  expectVerdict(2, {"--metric", "bias.ev", "--fail", "0.0001"}, "FAIL");
}

TEST_F(FlipLimits, WarningsCountOnlyWithWarnExit) {
  const std::vector<std::string> warn = {"--metric", "flip.mean", "--warn", "0.02", "--fail", "0.9"};
  expectVerdict(0, warn, "warning: mean FLIP");
  expectVerdict(1, join({warn, {"--warn-exit"}}), "warning: mean FLIP");
}

// The block and FLIP's reach around it are some 10 % of the pixels, and no more than (16+20)^2/64^2 = 32 %.
TEST_F(FlipLimits, PixelsOverALimitAreCountedAsIdiffDoes) {
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1"}, "of the pixels have FLIP over 0.1");
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1", "--failpercent", "1"}, "of the pixels have FLIP over 0.1");
  expectVerdict(0, {"--metric", "flip", "--fail", "0.1", "--failpercent", "32"}, "pass");
  expectVerdict(2, {"--fail", "0.1"}, "of the pixels have FLIP over 0.1");
  expectVerdict(1, {"--warn", "0.1", "--warnpercent", "1", "--warn-exit"}, "of the pixels have FLIP over 0.1");
}

TEST_F(FlipLimits, SinglePixelFailsTheHardLimit) {
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1", "--failpercent", "99", "--hardfail", "0.15"}, "FAIL");
  expectVerdict(0, {"--metric", "flip", "--fail", "0.1", "--failpercent", "99", "--hardfail", "0.999"}, "pass");
  expectVerdict(2, {"--metric", "flip.mean", "--fail", "0.9", "--hardfail", "0.15"}, "FAIL");
  expectVerdict(1, {"--hardwarn", "0.15", "--warn-exit"}, "warning");
}

TEST_F(FlipLimits, EachMetricHasTheLimitsBehindIt) {
  expectVerdict(2, {"--metric", "rmse", "--fail", "0.9", "--metric", "flip.mean", "--fail", "0.02"}, "FAIL: mean FLIP");
  expectVerdict(2, {"--metric", "rmse", "--fail", "0.001", "--metric", "flip.mean", "--fail", "0.9"}, "FAIL: RMSE");
  expectVerdict(0, {"--metric", "rmse", "--fail", "0.9", "--metric", "flip.mean", "--fail", "0.9"}, "pass");
}

// The block is 6.25 % of the pixels; elsewhere nothing differs.
TEST_F(FlipLimits, PixelsAreAlsoCountedByTheirLargestDifference) {
  expectVerdict(2, {"--metric", "maxabs", "--fail", "0.01", "--failpercent", "6"}, "FAIL");
  expectVerdict(0, {"--metric", "maxabs", "--fail", "0.01", "--failpercent", "6.25"}, "pass");
  expectVerdict(2, {"--metric", "maxabs", "--fail", "0.01"}, "FAIL");
}

TEST_F(FlipLimits, OnlyWhatIsAskedForIsMeasured) {
  const nlohmann::json rmse = flipJson({path("a.exr"), path("b.exr"), "--metrics", "rmse"});
  EXPECT_EQ(firstFigures(rmse).size(), 1u);
  EXPECT_TRUE(rmse["pairs"][0]["pooling"].is_null()) << "FLIP was computed though nobody asked for it";
}

TEST_F(FlipLimits, BudgetRulesThatJudgeNothingAreNamed) {
  const std::string budgets = path("budgets.toml");
  const std::string strict = "[[material]]\nname = \"*\"\nchecks = [ { metric = \"flip.max\", fail = 0 } ]\n";
  writeFile(budgets, strict);
  const RunResult whole = flip({"--budgets", budgets});
  EXPECT_TRUE(contains(whole.err, "line 1 ('*')")) << whole.err;
  EXPECT_TRUE(contains(whole.err, "without a mask")) << whole.err;
  base::writeImage(m_folder / "mask.png", base::Image(64, 64, 1, 1.f));
  const RunResult masked = flip({"--budgets", budgets, "--mask", path("mask.png")});
  EXPECT_TRUE(exitedWith(2, masked)) << "the rule judges regions of a mask";
  EXPECT_EQ(masked.err, "");
}

TEST_F(FlipLimits, RegressionsAreNotJudgedWithoutABaseline) {
  const std::string budgets = path("budgets.toml");
  const std::string regress = "regress = [ { metric = \"flip.mean\", fail = 0.1 } ]\n";
  writeFile(budgets, "[[whole]]\nchecks = [ { metric = \"flip.mean\", fail = 0.9 } ]\n" + regress);
  const std::vector<std::string> pair = {path("a.exr"), path("b.exr")};
  const nlohmann::json row = flipJson(join({pair, {"--budgets", budgets}}))["pairs"][0]["regions"][0];
  EXPECT_EQ(row["verdict"], "pass");
  EXPECT_EQ(row["checks"][1]["regress"], true);
  EXPECT_NE(row["checks"][1]["unjudged"], "");
  writeFile(budgets, "[[whole]]\n" + regress);
  const nlohmann::json alone = flipJson(join({pair, {"--budgets", budgets}}), 4)["pairs"][0];
  EXPECT_TRUE(contains(alone["reason"], "no baseline")) << alone["reason"];
}

TEST_F(FlipLimits, BudgetFileJudgesTheWholeImage) {
  writeFile(m_folder / "budgets.toml", "[[whole]]\nchecks = [ { metric = \"rmse\", fail = 0.001 } ]\n");
  expectVerdict(2, {"--budgets", path("budgets.toml")}, "RMSE");
}

TEST_F(FlipLimits, LimitThatCannotBeMeantIsAUsageError) {
  const auto refused = [&](const std::vector<std::string>& options, const std::vector<std::string>& parts) {
    const RunResult result = flip(options);
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_EQ(result.out, "");
    for (const std::string& part : parts) EXPECT_TRUE(contains(result.err, part)) << part << " in " << result.err;
  };
  refused({"--metric", "flip.meen", "--fail", "0.1"}, {"flip.meen", "'flip.mean'"});
  refused({"--metrics", "flip,ssym"}, {"ssym", "did you mean 'ssim'"});
  refused({"--metric", "bias", "--fail", "0.1"}, {"bias.ev", "has several figures"});
  refused({"--metric", "flip.mean"}, {"no limit follows it"});
  refused({"--metric", "flip", "--failpercent", "5"}, {"--failpercent", "--fail"});
  refused({"--metric", "flip.mean", "--fail", "0.1", "--failpercent", "5"}, {"flip.mean", "one figure"});
  refused({"--metric", "flip", "--fail", "0.1", "--failpercent", "101"}, {"--failpercent", "0 to 100"});
  refused({"--metric", "flip.mean", "--fail", "nan"}, {"--fail", "finite"});
  refused({"--metric", "flip.mean", "--fail", "1.5"}, {"flip.mean", "1.5"});
  refused({"--metrics", ""}, {"--metrics", "empty value"});
  refused({"--metric", "flip.mean", "--warn", "0.2", "--fail", "0.1"}, {"--warn", "never warn"});
  refused({"--metric", "psnr", "--warn", "20", "--fail", "30"}, {"--warn", "never warn"});
  refused({"--warn", "0.3", "--fail", "0.2"}, {"--warn", "never warn"});
  refused({"--ldr", "--tonemapper", "hable"}, {"--ldr", "--tonemapper"});
  refused({"--fail", "0.1", "--fail", "0.2"}, {"--fail", "twice"});
  refused({"--ldr", "--metrics", "hdrflip"}, {"hdrflip", "does not apply"});
  refused({"--ldr", "--metric", "hdrflip.mean", "--fail", "0.1"}, {"hdrflip.mean", "does not apply"});
}

// A limit that nothing can be beyond would be a pass whatever the pictures hold.
TEST_F(FlipLimits, LimitThatCannotTripIsAUsageError) {
  for (const std::vector<std::string>& options :
       std::vector<std::vector<std::string>>{{"--metric", "flip.mean", "--fail", "1"},
                                             {"--metric", "ssim.mean", "--fail", "-1"},
                                             {"--metric", "psnr", "--fail", "0"},
                                             {"--metric", "flip.fraction_over(0.1)", "--fail", "1"},
                                             {"--metric", "flip.mean", "--fail", "0.1", "--hardfail", "1"},
                                             {"--fail", "0.1", "--failpercent", "100"}}) {
    const RunResult result = flip(options);
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_TRUE(contains(result.err, "would always pass")) << result.err;
  }
  EXPECT_TRUE(contains(flip({"--fail", "1"}).err, "no pixel can be above it"));
}

TEST_F(FlipLimits, MetricThatDoesNotApplyIsNotComparable) {
  const RunResult result = flip({"--metrics", "hdrflip"});
  expectRefused(result, 3, {"hdrflip", "does not apply", "--hdr"});
  EXPECT_TRUE(exitedWith(0, flip({"--metrics", "hdrflip", "--hdr"})));
}

TEST_F(FlipLimits, FailureIsAnAnnotationAndAJunitFailure) {
  const std::string junit = path("junit.xml");
  const RunResult result = flip({"--metric", "flip.mean", "--fail", "0.02", "--junit", junit, "--annotate", "github"});
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_TRUE(contains(result.out, "::error title=parity%3A ")) << result.out;
  EXPECT_TRUE(contains(readWholeFile(junit), "<failure")) << readWholeFile(junit);
  EXPECT_TRUE(contains(readWholeFile(junit), "mean FLIP"));
}

TEST_F(FlipLimits, AnnotationStandsAtTheRuleOrTheLineOfTheList) {
  writeFile(m_folder / "b.toml", std::string("[[whole]]\nchecks = [ { metric = \"rmse\", fail = 0.001 } ]\n"));
  writeFile(m_folder / "list.txt", std::string("# pairs\na.exr b.exr\n"));
  RunOptions here;
  here.workingFolder = m_folder / ".";
  const RunResult rule = runParity({"flip", "a.exr", "b.exr", "--budgets", "b.toml", "--annotate", "github"}, here);
  EXPECT_TRUE(contains(rule.out, "::error file=b.toml,line=1,title=parity%3A ")) << rule.out;
  const RunResult line =
      runParity({"flip", "--pairs", "list.txt", "--metric", "rmse", "--fail", "0.001", "--annotate", "github"}, here);
  EXPECT_TRUE(contains(line.out, "::error file=list.txt,line=2,title=parity%3A ")) << line.out;
}

TEST_F(FlipLimits, WithoutAnyNothingReadsAsAPass) {
  const std::string junit = path("junit.xml");
  const std::vector<std::string> pair = {path("a.exr"), path("b.exr")};
  const nlohmann::json json = flipJson(join({pair, {"--junit", junit}}));
  EXPECT_EQ(json["verdict"], "not judged");
  EXPECT_EQ(json["pairs"][0]["verdict"], "not judged");
  EXPECT_EQ(json["pairs"][0]["regions"][0]["verdict"], "not judged");
  EXPECT_TRUE(contains(readWholeFile(junit), "skipped=\"1\"")) << readWholeFile(junit);
  EXPECT_TRUE(contains(runParity(join({{"flip"}, pair, {"--csv", "-"}})).out, ",not judged,"));
}

TEST_F(FlipLimits, QuietLeavesTheVerdictToTheExitCode) {
  const RunResult result = flip({"--metric", "flip.mean", "--fail", "0.02", "-q"});
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_EQ(result.out + result.err, "");
}

// Colour is the same, alpha is not: of an HDR pair, whose own FLIP an alpha channel does not have.
TEST_F(FlipLimits, AlphaOfAnHdrPairIsJudgedByTheSameLimits) {
  base::Image a(16, 16, 4, 1.f);
  for (std::size_t p = 0; p < a.pixelCount(); ++p) a.pixels[4 * p] = 2;
  base::Image b = a;
  for (std::size_t p = 0; p < a.pixelCount(); ++p) b.pixels[4 * p + 3] = 0;
  base::writeImage(m_folder / "opaque.exr", a);
  base::writeImage(m_folder / "clear.exr", b);
  const std::vector<std::string> pair = {path("opaque.exr"), path("clear.exr"), "--alpha", "channel"};
  for (const std::vector<std::string>& limit :
       std::vector<std::vector<std::string>>{{"--fail", "0.05"},
                                             {"--metric", "hdrflip.mean", "--fail", "0.05"},
                                             {"--metric", "flip.mean", "--fail", "0.05"}}) {
    const nlohmann::json rows = flipJson(join({pair, limit}), 2)["pairs"][0]["regions"];
    EXPECT_EQ(rows[0]["verdict"], "pass");
    EXPECT_EQ(rows[1]["name"], "alpha");
    EXPECT_EQ(rows[1]["verdict"], "fail");
  }
}

} // namespace
} // namespace parity::tests
