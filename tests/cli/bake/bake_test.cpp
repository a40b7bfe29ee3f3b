// parity bake and --baked as a user meets them: what comes out, that it is the same each time, and that it may be
// moved.
#include <cstdlib>

#include "base/image/image_io.h"
#include "cli/bake/bake_harness.h"
#include "cli/layers.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using shading::Term;

const std::vector<std::string> kPaths = {"highend", "mobile"};

class BakedTest : public BakedRenderTest {
protected:
  json report(const std::vector<std::string>& words) const {
    const RunResult result = run(join({{"report"}, words, {"--size", "64x64", "-o", path("report")}}));
    EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.commandLine << "\n" << result.err;
    return readReport(m_folder / "report");
  }
  // With all terms as layers.
  base::Image render(const std::string& scene, const std::string& by, const std::vector<std::string>& more) const {
    EXPECT_TRUE(
        exitedWith(0, run(join({{"render", scene, "--path", by, "--terms", "-o", path("out.exr")}, kSmall, more}))));
    return base::readImage(m_folder / "out.exr");
  }
  base::Image renderTerm(const std::string& term, const std::string& by, const std::vector<std::string>& more) const {
    EXPECT_TRUE(exitedWith(
        0,
        run(join({{"render", "builtin:courtyard", "--path", by, "--term", term, "-o", path("t.exr")}, kSmall, more}))));
    return base::readImage(m_folder / "t.exr");
  }
  static double sumOfTerm(const base::Image& image, Term term) { return sumOf(image, channelOf(term)); }
};

const json& passOf(const json& scene, const std::string& name) {
  for (const json& pass : scene.at("passes"))
    if (pass.at("name") == name) return pass;
  throw std::out_of_range(name);
}

TEST_F(BakedTest, ScenesBakedTogetherAreReportedTogether) {
  const RunResult baked = run(join({{"bake", "builtin:room", "builtin:courtyard", "-o", path("two")}, kCapturedBake}));
  ASSERT_TRUE(exitedWith(0, baked));
  for (const std::string part : {"room: ", "courtyard: ", "1 environment capture", "million rays"})
    EXPECT_TRUE(contains(baked.out, part)) << part << " in " << baked.out;
  EXPECT_TRUE(contains(baked.err, "red wall: unwrapped into")) << baked.err;
  EXPECT_EQ(entries(), (std::vector<std::string>{"cache", "two"}));
  for (const std::string scene : {"room", "courtyard"})
    EXPECT_EQ(
        listFiles(m_folder / "two" / scene),
        (std::vector<std::string>{"capture-0.bin", "capture-0.exr", "highend-0.exr", "lightmap-0.exr", "manifest.json",
                                  "mobile-0.png", "objects.bin", "sun-field-0.png", "sun-mask-0.png"}));

  const json result = report({"builtin:room", "builtin:courtyard", "--baked", path("two"), "--validation"});
  ASSERT_EQ(result.at("scenes").size(), 2u);
  for (const json& scene : result.at("scenes")) {
    const std::string light = scene.at("light");
    EXPECT_TRUE(contains(light, "baked: 2 bounces, error 20 %, at most 512 samples")) << light;
    EXPECT_TRUE(contains(light, "ASTC 4x4; scale of mobile reflections: mixing")) << light;
    EXPECT_EQ(passOf(scene, "lightmap").at("count"), 1);
    EXPECT_EQ(passOf(scene, "environment captures").at("count"), 1);
  }
  // The folder of one of them goes as well, and so does one that was moved; relative ones are from where one stands.
  std::filesystem::rename(m_folder / "two" / "courtyard", m_folder / "moved");
  RunOptions there;
  there.workingFolder = m_folder.path();
  for (const std::string& folder : {path("moved"), std::string("moved"), std::string("./moved/")})
    EXPECT_TRUE(exitedWith(
        0,
        run(join({{"render", "builtin:courtyard", "--path", "mobile", "--baked", folder, "-o", path("a.png")}, kSmall}),
            there)));
}

TEST_F(BakedTest, LightIsInTheTermsOfBothPaths) {
  const std::string scene = "builtin:courtyard", folder = path("baked");
  ASSERT_TRUE(exitedWith(0, run(join({{"bake", scene, "-o", folder}, kCapturedBake}))));
  for (const std::string& by : kPaths) {
    SCOPED_TRACE(by);
    const base::Image image = render(scene, by, {"--baked", folder});
    EXPECT_GT(sumOfTerm(image, Term::lightmap), 0);
    EXPECT_GT(sumOfTerm(image, Term::sunDiffuse), 0) << "the sun is not in the lightmap";
    EXPECT_GT(sumOfTerm(image, Term::skySpecular), 0) << "of the capture";
    EXPECT_EQ(sumOfTerm(image, Term::skyDiffuse), 0) << "it is in the lightmap";
    EXPECT_EQ(sumOfTerm(image, Term::localDiffuse), 0);
    for (std::size_t p = 0; p < image.pixelCount(); ++p) {
      const float* pixel = image.pixels.data() + p * static_cast<std::size_t>(image.channels);
      for (int c = 0; c < 3; ++c) {
        double sum = 0;
        for (std::size_t t = 0; t < shading::kBaseTermCount; ++t) sum += pixel[channelOf(static_cast<Term>(t)) + c];
        if (sum == 0) continue; // no surface: the background is seen
        ASSERT_NEAR(sum, pixel[c], (by == "highend" ? 1e-3 : 4e-3) * std::max(1.0, sum)) << p;
      }
    }
    EXPECT_EQ(sumOfTerm(render(scene, by, {}), Term::lightmap), 0) << "without the bake";
  }
  // Terms and the values that the base pass names.
  for (const std::string& by : kPaths) EXPECT_GT(sumOf(renderTerm("lightmap", by, {"--baked", folder}), 0), 0) << by;
  EXPECT_GT(sumOf(renderTerm("IndirectColor", "mobile", {"--baked", folder}), 0), 0);
  const base::Image shadow = renderTerm("Shadow", "mobile", {"--baked", folder});
  const base::Image open = renderTerm("Shadow", "mobile", {});
  EXPECT_GT(sumOf(shadow, 0), 0);
  EXPECT_LT(sumOf(shadow, 0), 0.99 * sumOf(open, 0)) << "the distance field takes sun away";
}

TEST_F(BakedTest, LampsAreBakedForBothPathsOrForMobileAlone) {
  const std::string scene = writeEmbedded(m_folder, makeLitCorner());
  const std::string fixed = bake({scene}, "static"),
                    stationary = bake({scene}, "own", {"--local-lights", "stationary"});
  const auto lampOf = [&](const std::string& folder, const std::string& by) {
    const base::Image image = render(scene, by, {"--baked", folder});
    EXPECT_GT(sumOfTerm(image, Term::lightmap), 0) << by;
    const double diffuse = sumOfTerm(image, Term::localDiffuse), specular = sumOfTerm(image, Term::localSpecular);
    EXPECT_EQ(diffuse > 0, specular > 0) << by;
    return diffuse;
  };
  EXPECT_EQ(lampOf(fixed, "highend"), 0);
  EXPECT_EQ(lampOf(fixed, "mobile"), 0);
  EXPECT_GT(lampOf(stationary, "highend"), 0);
  EXPECT_EQ(lampOf(stationary, "mobile"), 0);
  // High-end's own lamp takes the place of what its lightmap has not.
  const double whole = sumOfTerm(render(scene, "highend", {"--baked", fixed}), Term::lightmap);
  EXPECT_LT(sumOfTerm(render(scene, "highend", {"--baked", stationary}), Term::lightmap), 0.7 * whole);
}

TEST_F(BakedTest, TruthKnowsOfNoBakedLight) {
  const std::string scene = writeEmbedded(m_folder, makeLitCorner()), folder = bake({scene}, "baked");
  const std::vector<std::string> with = {"--baked", folder};
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"diff", scene}, {"report", scene, "-o", path("report")}}) {
    const RunResult result = run(join({words, {"--truth"}, with}));
    EXPECT_TRUE(exitedWith(64, result));
    EXPECT_TRUE(contains(result.err, "--truth: cannot be combined with --baked")) << result.err;
  }
  expectRefused(run(join({{"render", scene, "--path", "truth", "-o", path("a.exr")}, with})), 64,
                {"--baked", "the truth does not use baked light"});
  EXPECT_FALSE(std::filesystem::exists(m_folder / "report"));
  EXPECT_FALSE(std::filesystem::exists(m_folder / "a.exr"));
}

TEST_F(BakedTest, ResultsComeFromTheCacheUnlessTheBakeIsAnother) {
  const std::string scene = writeEmbedded(m_folder, makeLitCorner()), folder = bake({scene}, "baked");
  const auto isCached = [&] {
    report({scene, "--baked", folder});
    return !json::parse(readWholeFile(m_folder / "report" / "run.json")).at("cachedScenes").empty();
  };
  EXPECT_FALSE(isCached());
  EXPECT_TRUE(isCached());
  bake({scene}, "baked"); // the same again
  EXPECT_TRUE(isCached());
  bake({scene}, "baked", {"--bounces", "0"});
  EXPECT_FALSE(isCached());
  bake({scene}, "baked", {"--bounces", "0", "--astc", "none"});
  EXPECT_FALSE(isCached());
}

TEST_F(BakedTest, NothingIsRecalledWhereAFileOfTheBakeIsMissingOrDamaged) {
  const std::string scene = writeEmbedded(m_folder, makeLitCorner()), folder = bake({scene}, "baked");
  const auto tryReport = [&] {
    return run(join({{"report", scene, "--baked", folder, "-o", path("report"), "--size", "64x64"}}));
  };
  ASSERT_NE(tryReport().exitCode, 4);
  for (const auto& [name, content] : readFolder(folder)) {
    if (name == "manifest.json" || name.starts_with("lightmap-")) continue;
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    std::filesystem::remove(file);
    const RunResult missing = tryReport();
    EXPECT_TRUE(exitedWith(4, missing)) << name;
    EXPECT_TRUE(contains(missing.err, name) && contains(missing.err, "does not exist")) << missing.err;
    std::string damaged = content;
    damaged[damaged.size() / 2] ^= 1;
    writeFile(file, damaged);
    const RunResult changed = tryReport();
    EXPECT_TRUE(exitedWith(4, changed)) << name;
    EXPECT_TRUE(contains(changed.err, name + ": does not match its hash in the manifest")) << changed.err;
    writeFile(file, content);
  }
  ASSERT_NE(tryReport().exitCode, 4);
  EXPECT_FALSE(json::parse(readWholeFile(m_folder / "report" / "run.json")).at("cachedScenes").empty());
}

using BakeRepeatTest = BakeTest;

TEST_F(BakeRepeatTest, IsTheSameForAnyNumberOfThreadsAndAnotherForAnotherSeed) {
  GltfFile file = makeLitCorner();
  file.material()["emissiveFactor"] = {0.5, 0.4, 0.3}; // sampled, unlike the lamp
  const std::string scene = writeEmbedded(m_folder, std::move(file));
  const auto content = [&](const std::string& name, const std::vector<std::string>& options) {
    EXPECT_TRUE(exitedWith(0, runParity(join({{"bake", scene, "-o", path(name), "--no-cache"}, kQuickBake, options}))));
    return readFolder(m_folder / name);
  };
  const FolderContent one = content("one", {"--threads", "1"});
  EXPECT_EQ(one.size(), 5u) << "no sun, no capture";
  EXPECT_TRUE(one == content("two", {"--threads", "2"}));
  const FolderContent other = content("seed", {"--seed", "1"});
  EXPECT_TRUE(one.at("objects.bin") != other.at("objects.bin") || one.at("mobile-0.png") != other.at("mobile-0.png"));
  EXPECT_NE(one.at("lightmap-0.exr"), other.at("lightmap-0.exr"));
}

TEST_F(BakeRepeatTest, CapturesAreTheSameEachTime) {
  if (const std::string missing = missingDriver(); !missing.empty()) GTEST_SKIP() << missing;
  const std::string scene = writeEmbedded(m_folder, makeLitCorner());
  for (const std::string name : {"one", "two"})
    ASSERT_TRUE(exitedWith(0, runParity(join({{"bake", scene, "--sun", "30,50,4", "--no-cache", "-o", path(name),
                                               "--threads", name == "one" ? "1" : "2"},
                                              kCapturedBake}))));
  EXPECT_TRUE(readFolder(m_folder / "one") == readFolder(m_folder / "two"));
}

// Captures are read by the walls of their box, and the lightmap of high quality, where that is asked for. The room has
// a metal ball within its box.
TEST_F(BakedTest, ParallaxAndTheFormOfTheLightmapMakeOtherPicturesOfARoom) {
  const std::string folder = path("captured");
  ASSERT_TRUE(exitedWith(0, run(join({{"bake", "builtin:room", "-o", folder}, kCapturedBake}))));
  const auto draw = [&](const std::vector<std::string>& more) {
    const RunResult drawn = run(
        join({{"render", "builtin:room", "--path", "mobile", "--baked", folder, "--size", "32x32", "-o", path("p.exr")},
              more}));
    EXPECT_TRUE(exitedWith(0, drawn));
    return readWholeFile(path("p.exr"));
  };
  const std::string plain = draw({});
  EXPECT_TRUE(plain != draw({"--mobile-parallax"}));
  EXPECT_TRUE(plain != draw({"--mobile-lightmap", "hq"}));
}

TEST_F(BakeRepeatTest, NotesOfManyMeshesAreCutShortUnlessAskedFor) {
  GltfFile file = makeLitCorner();
  const json mesh = file.json["meshes"][0];
  for (int i = 0; i < 30; ++i) {
    file.json["scenes"][0]["nodes"].push_back(file.json["nodes"].size());
    file.json["nodes"].push_back({{"mesh", file.json["meshes"].size()}, {"translation", {0, 1 + i, 0}}});
    file.json["meshes"].push_back(mesh);
  }
  const std::string scene = writeEmbedded(m_folder, std::move(file));
  const auto notes = [](const RunResult& result) {
    std::size_t count = 0;
    for (const std::string& line : linesOf(result.err)) count += contains(line, "unwrapped into");
    return count;
  };
  const RunResult few = tryBake({scene}, "a"), all = tryBake({scene}, "b", {"-v"}),
                  none = tryBake({scene}, "c", {"-q"});
  EXPECT_EQ(notes(few), 20u) << few.err;
  EXPECT_TRUE(contains(few.err, "and 12 more notes (-v shows all)")) << few.err;
  EXPECT_EQ(notes(all), 32u) << all.err;
  EXPECT_EQ(none.err + none.out, "");
}

} // namespace
} // namespace parity::tests
