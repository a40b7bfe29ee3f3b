// parity flip judges by the limits it is given: pooled and pixelwise, each with its exit code and its reason in words.
#include "base/image_io.h"
#include "cli/flip_pictures.h"

namespace parity::tests {
namespace {

// A picture, and one of which a block of 16x16 in 64x64 (6.25 % of the pixels) is much brighter.
class FlipLimits : public testing::Test {
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
    return runParity(join({{"flip", (m_folder / "a.exr").string(), (m_folder / "b.exr").string()}, more}));
  }

  void expectVerdict(int code, const std::vector<std::string>& options, const std::string& words) const {
    const RunResult result = flip(options);
    EXPECT_TRUE(exitedWith(code, result));
    EXPECT_TRUE(contains(splitLines(result.out).back(), words)) << result.commandLine << "\n" << result.out;
  }

  const TempFolder m_folder;
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
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1"}, "share of pixels");
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1", "--failpercent", "1"}, "share of pixels");
  expectVerdict(0, {"--metric", "flip", "--fail", "0.1", "--failpercent", "32"}, "pass");
  expectVerdict(2, {"--fail", "0.1"}, "share of pixels");
  expectVerdict(1, {"--warn", "0.1", "--warnpercent", "1", "--warn-exit"}, "share of pixels");
}

TEST_F(FlipLimits, SinglePixelFailsTheHardLimit) {
  expectVerdict(2, {"--metric", "flip", "--fail", "0.1", "--failpercent", "100", "--hardfail", "0.15"}, "FAIL");
  expectVerdict(0, {"--metric", "flip", "--fail", "0.1", "--failpercent", "100", "--hardfail", "1"}, "pass");
  expectVerdict(2, {"--metric", "flip.mean", "--fail", "0.9", "--hardfail", "0.15"}, "FAIL");
  expectVerdict(1, {"--hardwarn", "0.15", "--warn-exit"}, "warning");
}

TEST_F(FlipLimits, EachMetricHasTheLimitsBehindIt) {
  expectVerdict(2, {"--metric", "rmse", "--fail", "0.9", "--metric", "flip.mean", "--fail", "0.02"}, "FAIL: mean FLIP");
  expectVerdict(2, {"--metric", "rmse", "--fail", "0.001", "--metric", "flip.mean", "--fail", "0.9"}, "FAIL: RMSE");
  expectVerdict(0, {"--metric", "rmse", "--fail", "0.9", "--metric", "flip.mean", "--fail", "0.9"}, "pass");
}

TEST_F(FlipLimits, BudgetFileJudgesTheWholeImage) {
  writeFile(m_folder / "budgets.toml", "[[whole]]\nchecks = [ { metric = \"rmse\", fail = 0.001 } ]\n");
  expectVerdict(2, {"--budgets", (m_folder / "budgets.toml").string()}, "RMSE");
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
  refused({"--metric", "bias", "--fail", "0.1"}, {"bias.ev", "which of its figures"});
  refused({"--metric", "flip.mean"}, {"no limit stands behind it"});
  refused({"--metric", "flip", "--failpercent", "5"}, {"--failpercent", "--fail"});
  refused({"--metric", "flip.mean", "--fail", "0.1", "--failpercent", "5"}, {"flip.mean", "one figure"});
  refused({"--metric", "flip", "--fail", "0.1", "--failpercent", "101"}, {"--failpercent", "0 to 100"});
  refused({"--metric", "flip.mean", "--fail", "nan"}, {"--fail", "finite"});
  refused({"--metric", "flip.mean", "--fail", "1.5"}, {"flip.mean", "1.5"});
  refused({"--fail", "0.1", "--fail", "0.2"}, {"--fail", "twice"});
  refused({"--ldr", "--metrics", "hdrflip"}, {"hdrflip", "does not apply"});
  refused({"--ldr", "--metric", "hdrflip.mean", "--fail", "0.1"}, {"hdrflip.mean", "does not apply"});
}

TEST_F(FlipLimits, MetricThatDoesNotApplyIsNotComparable) {
  const RunResult result = flip({"--metrics", "hdrflip"});
  expectRefused(result, 3, {"hdrflip", "does not apply", "--hdr"});
  EXPECT_TRUE(exitedWith(0, flip({"--metrics", "hdrflip", "--hdr"})));
}

TEST_F(FlipLimits, FailureIsAnAnnotationAndAJunitFailure) {
  const std::string junit = (m_folder / "junit.xml").string();
  const RunResult result = flip({"--metric", "flip.mean", "--fail", "0.02", "--junit", junit, "--annotate", "github"});
  EXPECT_TRUE(exitedWith(2, result));
  EXPECT_TRUE(contains(result.out, "::error title=parity%3A ")) << result.out;
  EXPECT_TRUE(contains(readWholeFile(junit), "<failure")) << readWholeFile(junit);
  EXPECT_TRUE(contains(readWholeFile(junit), "mean FLIP"));
}

} // namespace
} // namespace parity::tests
