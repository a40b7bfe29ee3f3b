// Pictures of other engines as paths of a report: what is compared with what, and what is refused.
#include <fmt/format.h>

#include "base/image/image_io.h"
#include "cli/checks.h"
#include "external/registration.h"

namespace parity::tests {
namespace {

const std::vector<std::string> kSize = {"--size", "128x128", "--validation"};

class ExternalTest : public RenderingTest {
protected:
  // Of the scene "Balls", with these externals.
  std::string suite(const std::string& externals) const {
    return write("suite.toml", "[[scene]]\nname = \"Balls\"\nfile = \"builtin:materials\"\nenvironment = "
                               "\"builtin:studio\"\n" +
                                   externals);
  }
  static std::string external(const std::string& name, const std::string& more) {
    return fmt::format("[[scene.external]]\nname = \"{}\"\n{}\n", name, more);
  }
  // The picture that a path of ours makes of that view.
  void draw(const std::string& by, const std::string& file, const std::vector<std::string>& more = kSize,
            const std::string& scene = "builtin:materials") const {
    ASSERT_TRUE(exitedWith(
        0, runParity(join({{"render", scene, "--path", by, "--env", "builtin:studio", "-o", path(file)}, more}))));
  }
  RunResult report(const std::string& externals, const std::vector<std::string>& more = {}) const {
    return runParity(join({{"report", "--suite", suite(externals), "-o", path("out")}, kSize, more}));
  }
  // calibration.exr: the calibration scene by the high-end path.
  void calibrate(const std::vector<std::string>& more = {}, bool isLit = true) const {
    ASSERT_TRUE(exitedWith(0, runParity({"contract", "builtin:spheres", "-o", path("contract"), "--size", "16x16",
                                         "--env", "builtin:studio"})));
    const std::vector<std::string> light = {"--env", path("contract/calibration.hdr")};
    ASSERT_TRUE(exitedWith(
        0, runParity(join({{"render", path("contract/calibration.glb"), "--camera", "calibration", "--path", "highend",
                            "--size", "512x512", "--background", "0,0,0", "-o", path("calibration.exr")},
                           isLit ? light : std::vector<std::string>(),
                           more}))));
  }
  nlohmann::json views() const { return readReport(m_folder / "out")["scenes"][0]["views"]; }
  static double flip(const nlohmann::json& row) { return row["figures"]["metrics"]["flip.mean"]; }
  // The report is there, the scene is an error of the exit code 3 for this reason, and the paths' row was compared.
  void expectNotComparable(const std::string& externals, const std::string& reason) const {
    const RunResult run = report(externals);
    EXPECT_TRUE(exitedWith(3, run));
    EXPECT_TRUE(contains(run.err, reason)) << run.err;
    const nlohmann::json scene = readReport(m_folder / "out")["scenes"][0];
    EXPECT_EQ(scene["error"]["exitCode"], 3);
    ASSERT_EQ(scene["views"].size(), 1u) << "what was compared is not lost";
    EXPECT_EQ(scene["views"][0]["test"], "mobile");
  }
};

TEST_F(ExternalTest, APictureIsAPathThatIsJudgedByMaterial) {
  draw("highend", "Balls-auto.png");
  std::filesystem::rename(path("Balls-auto.png"), path("same.png"));
  draw("mobile", "mobile.png");
  const RunResult run = report(external("same", "test = \"same.png\"") + external("theirs", "test = \"mobile.png\""));
  ASSERT_TRUE(isReported(run));
  const nlohmann::json rows = views();
  ASSERT_EQ(rows.size(), 3u);
  EXPECT_EQ(rows[1]["name"], "auto (same)");
  EXPECT_EQ(rows[1]["reference"], "highend");
  EXPECT_EQ(rows[1]["test"], "same");
  EXPECT_EQ(rows[1]["whole"]["figures"]["metrics"]["flip.mean"], 0);
  for (const nlohmann::json& row : rows) // the page says by it why no cause is named
    for (const nlohmann::json& material : row["materials"])
      EXPECT_EQ(material.value("external", false), row["test"] != "mobile") << row["test"];
  for (const nlohmann::json& material : rows[1]["materials"])
    if (!material["figures"].is_null()) {
      EXPECT_EQ(flip(material), 0) << material["name"];
    }
  // A picture of the mobile path is what the mobile path is: of materials in full pixels to the last step.
  EXPECT_EQ(rows[2]["whole"]["figures"]["metrics"]["flip.mean"], rows[0]["whole"]["figures"]["metrics"]["flip.mean"]);
  for (std::size_t m = 0; m < rows[0]["materials"].size(); ++m) {
    if (rows[0]["materials"][m]["figures"].is_null()) continue;
    EXPECT_NEAR(flip(rows[2]["materials"][m]), flip(rows[0]["materials"][m]), 1e-3) << m;
  }
}

TEST_F(ExternalTest, TakesThePlaceOfAPathOrOfTheReference) {
  draw("mobile", "mobile.png");
  draw("highend", "highend.png");
  ASSERT_TRUE(isReported(report(external("theirs", "test = \"mobile.png\"\nreplaces = \"mobile\""))));
  ASSERT_EQ(views().size(), 1u);
  EXPECT_EQ(views()[0]["name"], "auto");
  EXPECT_EQ(views()[0]["test"], "theirs");
  const double first = views()[0]["whole"]["figures"]["metrics"]["flip.mean"];
  ASSERT_TRUE(isReported(report(external("theirs", "test = \"highend.png\"\nreplaces = \"reference\""))));
  ASSERT_EQ(views().size(), 1u);
  EXPECT_EQ(views()[0]["reference"], "theirs");
  EXPECT_EQ(views()[0]["test"], "mobile");
  EXPECT_NEAR(views()[0]["whole"]["figures"]["metrics"]["flip.mean"].get<double>(), first, 1e-3);
}

TEST_F(ExternalTest, TwoEnginesAreHeldAgainstEachOther) {
  std::filesystem::create_directories(path("desktop"));
  draw("highend", "desktop/Balls-auto.png");
  draw("mobile", "phone.png");
  ASSERT_TRUE(isReported(report(external("phone", "test = \"phone.png\"\nreference = \"desktop\""))));
  const nlohmann::json rows = views();
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[1]["reference"], "phone reference");
  EXPECT_EQ(rows[1]["test"], "phone");
  EXPECT_NEAR(rows[1]["whole"]["figures"]["metrics"]["flip.mean"].get<double>(),
              rows[0]["whole"]["figures"]["metrics"]["flip.mean"].get<double>(), 1e-3);
}

TEST_F(ExternalTest, TheFactsOfAPictureAreHeldAgainstTheTruth) {
  draw("highend", "same.png");
  ASSERT_TRUE(isReported(report(external("same", "test = \"same.png\""), {"--truth", "--error", "10%"})));
  const nlohmann::json truth = views()[1]["whole"]["truth"];
  ASSERT_FALSE(truth.is_null());
  EXPECT_EQ(truth["terms"].size(), 0u) << "of a picture no terms are known";
}

// Also over black, where edges are those of the silhouettes alone.
TEST_F(ExternalTest, ASmallShiftIsPutRightAndALargeOneRefused) {
  for (const std::string background : {"0.18,0.18,0.18", "0,0,0"}) {
    const std::vector<std::string> fine = {"--samples", "16", "--background", background};
    draw("highend", "whole.exr", join({kSize, fine}));
    const base::Image whole = base::readImage(path("whole.exr"));
    const auto shifted = [&](const std::string& file, double dx) {
      base::writeImage(path(file), external::placedOnView(whole, {.dx = -dx}));
      return external("moved", fmt::format("transfer = \"linear\"\ntest = \"{}\"", file));
    };
    const RunResult run = report(shifted("a.exr", 0.3), fine);
    ASSERT_TRUE(isReported(run));
    EXPECT_TRUE(contains(run.err, "the picture of moved lies 0.")) << run.err;
    double found = 0;
    const std::size_t at = run.err.find("beside it (");
    ASSERT_EQ(std::sscanf(run.err.c_str() + at, "beside it (%lf to the right", &found), 1) << run.err;
    EXPECT_NEAR(found, 0.3, 0.05);
    EXPECT_TRUE(contains(run.err, "that is put right")) << run.err;
    EXPECT_LT(views()[1]["whole"]["figures"]["metrics"]["flip.mean"], 0.03);
    for (const double shift : {0.6, 1.0, 2.0}) {
      const RunResult refused = report(shifted("b.exr", shift), fine);
      EXPECT_TRUE(exitedWith(3, refused));
      const std::size_t place = refused.err.find("b.exr: lies ");
      ASSERT_NE(place, std::string::npos) << refused.err;
      ASSERT_EQ(std::sscanf(refused.err.c_str() + place, "b.exr: lies %lf pixels beside the view", &found), 1);
      EXPECT_NEAR(found, shift, 0.07) << background;
    }
  }
}

// The calibration's picture is right, and yet this view lies beside: its camera or size is at fault.
TEST_F(ExternalTest, EachViewsPlaceIsLookedAtUnderACalibration) {
  calibrate();
  draw("highend", "whole.exr", join({kSize, {"--samples", "16"}}));
  const base::Image whole = base::readImage(path("whole.exr"));
  const std::string keys = "transfer = \"linear\"\ncalibration = \"calibration.exr\"\n";
  ASSERT_TRUE(isReported(report(external("x", keys + "test = \"whole.exr\""), {"--samples", "16"})));
  base::writeImage(path("moved.exr"), external::placedOnView(whole, {.dx = -2}));
  expectNotComparable(external("x", keys + "test = \"moved.exr\""),
                      "although the calibration's place is put right: mend the camera of this view");
}

// The calibration scene by our own path, as a picture of that transfer.
TEST_F(ExternalTest, ACurveIsFittedToTheCalibration) {
  calibrate();
  draw("mobile", "mobile.exr");
  draw("mobile", "mobile.png");
  const auto encoded = [&](const std::string& from, const std::string& to) { // three.js' Cineon, of 8 bits
    const base::Image light = base::readImage(path(from));
    base::Image8 out(light.width, light.height, 3);
    for (std::size_t i = 0; i < light.pixels.size(); ++i) {
      const double v = std::max(0.0, static_cast<double>(light.pixels[i]) - 0.004);
      const double value = (v * (6.2 * v + 0.5)) / (v * (6.2 * v + 1.7) + 0.06);
      out.pixels[i] = static_cast<std::uint8_t>(std::clamp(value, 0.0, 1.0) * 255 + 0.5);
    }
    base::writeImage8(path(to), out);
  };
  encoded("calibration.exr", "cineon.png");
  encoded("mobile.exr", "shot.png");
  const auto external = [&](const std::string& keys) { return ExternalTest::external("theirs", keys); };
  const std::string fitted = external("test = \"shot.png\"\ntransfer = \"fitted\"\ncalibration = \"cineon.png\"");
  ASSERT_TRUE(isReported(report(fitted)));
  const auto mean = [&](std::size_t row) {
    return views()[row]["whole"]["figures"]["metrics"]["flip.mean"].get<double>();
  };
  EXPECT_NEAR(mean(1), mean(0), 0.02) << "as the mobile path itself";
  ASSERT_TRUE(isReported(report(external("test = \"shot.png\""))));
  EXPECT_GT(mean(1), mean(0) + 0.02) << "read as sRGB it is another picture";
  expectNotComparable(external("test = \"shot.png\"\ncalibration = \"cineon.png\""),
                      "transfer = \"fitted\" reads it from the ramp");
}

// An engine whose filter is two pixels wide: the report says how ours is rendered alike, and so it is.
TEST_F(ExternalTest, AFilterIsToldAndOursIsRenderedAlike) {
  const std::vector<std::string> fine = {"--samples", "16"}, wide = {"--samples", "16", "--filter-width", "2.0"};
  calibrate(wide);
  draw("highend", "wide.exr", join({kSize, wide}));
  const std::string theirs =
      external("x", "transfer = \"linear\"\ntest = \"wide.exr\"\ncalibration = \"calibration.exr\"");
  const auto mean = [&] { return views()[1]["whole"]["figures"]["metrics"]["flip.mean"].get<double>(); };
  const RunResult other = report(theirs, fine);
  ASSERT_TRUE(isReported(other));
  EXPECT_TRUE(contains(other.err, "--filter-width 2.0 renders ours alike")) << other.err;
  EXPECT_GT(mean(), 0.01);
  const RunResult alike = report(theirs, wide);
  ASSERT_TRUE(isReported(alike));
  EXPECT_FALSE(contains(alike.err, "renders ours alike")) << alike.err;
  EXPECT_LT(mean(), 0.001);
  const RunResult one = report(theirs);
  EXPECT_TRUE(contains(one.err, "ours is one sample: --samples 16 --filter-width 2.0 renders ours alike")) << one.err;
}

TEST_F(ExternalTest, AnEnvironmentThatIsNotSeenIsTold) {
  calibrate({}, false);
  draw("highend", "same.exr");
  const RunResult run =
      report(external("x", "transfer = \"linear\"\ntest = \"same.exr\"\ncalibration = \"calibration.exr\""));
  ASSERT_TRUE(isReported(run));
  EXPECT_TRUE(contains(run.err, "the mirror ball does not show the environment's spots")) << run.err;
}

TEST_F(ExternalTest, WhatCannotBeComparedIsNoPass) {
  draw("highend", "other.png", {"--size", "64x64"});
  expectNotComparable(external("x", "test = \"other.png\""), "is 64 x 64 pixels; the view is 128 x 128");
  draw("highend", "lamps.png", kSize, "builtin:lamps");
  expectNotComparable(external("x", "test = \"lamps.png\""), "does not show the view 'auto'");
  draw("highend", "same.exr");
  expectNotComparable(external("x", "test = \"same.exr\""),
                      "holds floats, which are linear light; its transfer is 'srgb'");
  draw("highend", "same.png");
  const base::Image8 rgb = base::readImage8(path("same.png"), 3);
  base::Image8 rgba(rgb.width, rgb.height, 4, 128);
  for (std::size_t i = 0; i < rgb.pixelCount(); ++i) std::copy_n(&rgb.pixels[3 * i], 3, &rgba.pixels[4 * i]);
  base::writeImage8(path("alpha.png"), rgba);
  expectNotComparable(external("x", "test = \"alpha.png\""), "pixels of materials are transparent");
  expectNotComparable(external("x", "test = \"same.png\"\ncalibration = \"same.png\""),
                      "does not show the calibration scene");

  const RunResult missing = report(external("x", "test = \"none.png\""));
  EXPECT_TRUE(exitedWith(4, missing));
  EXPECT_TRUE(contains(missing.err, "none.png")) << missing.err;
  const std::string whole = readWholeFile(path("same.png"));
  write("cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_TRUE(exitedWith(4, report(external("x", "test = \"cut.png\""))));

  // Without the bad ones the good one is compared.
  const RunResult both = report(external("good", "test = \"same.png\"") + external("bad", "test = \"other.png\"") +
                                external("worse", "test = \"none.png\""));
  EXPECT_TRUE(exitedWith(3, both));
  ASSERT_EQ(views().size(), 2u);
  EXPECT_EQ(views()[1]["test"], "good");
  EXPECT_TRUE(contains(both.err, "other.png")) << both.err;
  EXPECT_TRUE(contains(both.err, "none.png")) << "all are told: " << both.err;
}

TEST_F(ExternalTest, NanIsNoPass) {
  draw("highend", "same.exr");
  base::Image nan = base::readImage(path("same.exr"));
  const std::size_t middle = nan.pixels.size() / 2 + 3 * 64;
  std::fill_n(nan.pixels.begin() + static_cast<long>(middle), 30, NAN);
  base::writeImage(path("nan.exr"), nan);
  const RunResult run = report(external("x", "transfer = \"linear\"\ntest = \"nan.exr\""));
  EXPECT_TRUE(exitedWith(2, run));
  const nlohmann::json row = views()[1];
  EXPECT_EQ(row["whole"]["verdict"], "fail") << row["whole"].dump(1);
}

TEST_F(ExternalTest, SuitesAreRefusedInWords) {
  const auto refused = [&](const std::string& externals, const std::string& part) {
    expectRefused(report(externals), 4, {"suite.toml", part});
  };
  refused("[[scene.external]]\ntest = \"a.png\"\n", "name: is missing");
  refused(external("x", ""), "test: is missing");
  refused(external("x", "test = \"a.png\"\ntransfer = \"srbg\""), "did you mean 'srgb'");
  refused(external("x", "test = \"a.png\"\nreplaces = \"moble\""), "did you mean 'mobile'");
  refused(external("mobile", "test = \"a.png\""), "a path has this name");
  refused(external("truth", "test = \"a.png\""), "reports use this name for something else");
  refused(external("x", "test = \"a.png\"\ntransfer = \"fitted\""), "'fitted' needs 'calibration'");
  const std::string views = "[[scene.view]]\nname = \"left\"\norbit = [10, 20, 4]\n[[scene.view]]\nname = "
                            "\"right\"\norbit = [50, 20, 4]\n";
  refused(views + external("x", "test = \"a.png\""), "the views 'left' and 'right' have the same picture");
  refused(views + external("x", "test = \"{view}.png\"\nreference = \"a.png\""), "have the same picture");
  refused(external("x", "test = \"a.png\"\nreference = \"b.png\"") + external("x reference", "test = \"c.png\""),
          "the reference of another one has it");
  refused(external("x", "test = \"a.png\"") + external("x", "test = \"b.png\""), "have the name 'x'");
  refused(external("x", "test = \"a.png\"\ntets = \"b.png\""), "did you mean 'test'");
}

TEST_F(ExternalTest, AChangedPictureIsComparedAnew) {
  draw("highend", "shot.png");
  const std::string externals = external("theirs", "test = \"shot.png\"");
  const std::vector<std::string> cached = {"report",  "--suite",     suite(externals), "-o",     path("out"),
                                           "--cache", path("cache"), "--size",         "128x128"};
  ASSERT_TRUE(isReported(runParity(cached)));
  EXPECT_EQ(views()[1]["whole"]["figures"]["metrics"]["flip.mean"], 0);
  const nlohmann::json inputs = readReport(m_folder / "out")["scenes"][0]["inputs"];
  ASSERT_TRUE(isReported(runParity(cached)));
  EXPECT_EQ(nlohmann::json::parse(readWholeFile(m_folder / "out" / "run.json"))["cachedScenes"].size(), 1u);
  EXPECT_EQ(views().size(), 2u);
  draw("mobile", "shot.png");
  ASSERT_TRUE(isReported(runParity(cached)));
  EXPECT_GT(views()[1]["whole"]["figures"]["metrics"]["flip.mean"], 0.01);
  const nlohmann::json now = readReport(m_folder / "out")["scenes"][0]["inputs"];
  EXPECT_NE(now["pictures"], inputs["pictures"]) << "a history names it";
  EXPECT_EQ(now["asset"], inputs["asset"]);
}

} // namespace
} // namespace parity::tests
