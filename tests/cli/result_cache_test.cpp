// Whole results from the cache: the same bytes for less work, only for what is the same, and nothing is ever hurt by
// what a cache folder holds. Without the validation layer, under which nothing is recalled: DeterminismTest renders the
// like.
#include <map>
#include <thread>

#include "base/image/image_io.h"
#include "cli/checks.h"

namespace parity::tests {
namespace {

using Files = std::map<std::string, std::string>;

struct Report {
  RunResult run;
  Files files; // report.json, the pictures and the values behind them
  nlohmann::json info;
  std::vector<std::string> cached() const { return info["cachedScenes"].get<std::vector<std::string>>(); }
  bool did(const std::string& stage) const {
    for (const nlohmann::json& timing : info["timings"])
      if (timing["stage"] == stage) return true;
    return false;
  }
};

class ResultCacheTest : public RenderingTest {
protected:
  Report report(const std::vector<std::string>& scenes, const std::vector<std::string>& more = {}) const {
    const std::filesystem::path folder = m_folder / ("out" + std::to_string(m_runs++));
    std::vector<std::string> options = {"--size", "48x48", "--sun", "60,60,4", "-o", folder.string()};
    if (std::find(more.begin(), more.end(), "--no-cache") == more.end())
      options = join({options, {"--cache", cache().string()}});
    Report result{.run = runParity(join({{"report"}, scenes, options, more})), .files = {}, .info = {}};
    EXPECT_GE(result.run.exitCode, 0) << result.run.err;
    for (const std::string& file : listFiles(folder))
      if (file == "report.json" || file.ends_with(".png") || file.ends_with(".js"))
        result.files[file] = readWholeFile(folder / file);
    EXPECT_GE(result.files.size(), 4u) << result.run.err;
    result.info = nlohmann::json::parse(readWholeFile(folder / "run.json"));
    return result;
  }
  std::filesystem::path cache() const { return m_folder / "cache"; }

  void paint(const std::string& file, std::uint8_t red) const {
    base::Image8 image(4, 4, 3, 90);
    for (std::size_t i = 0; i < image.pixels.size(); i += 3) image.pixels[i] = red;
    base::writeImage8(m_folder / file, image);
  }
  // A scene that takes little time.
  std::string writeQuad() const { return writeEmbedded(m_folder, makeQuad(), "quad"); }
  // A quad with a texture in a file of its own.
  std::string writeScene(const std::string& name, const std::string& texture) const {
    GltfFile file = makeQuad();
    file.json["images"] = {{{"uri", texture}}};
    file.json["textures"] = {{{"source", 0}}};
    file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
    return writeExternal(m_folder, std::move(file), name);
  }

private:
  mutable int m_runs = 0;
};

const std::vector<std::string> kNone;

TEST_F(ResultCacheTest, ShadowsCount) {
  const std::vector<std::string> options = {"--no-sun-extraction"};
  const Report plain = report({"builtin:shadows"}, options);
  EXPECT_EQ(report({"builtin:shadows"}, options).cached().size(), 1u);
  for (const std::vector<std::string>& more : {std::vector<std::string>{"--shadows"},
                                               {"--mobile-spot-shadow"},
                                               {"--mobile-spot-shadow", "--mobile-spot-fade", "0.5"},
                                               {"--mobile-sun-shadow"},
                                               {"--mobile-sun-shadow", "--mobile-sun-distance", "3"},
                                               {"--direct-lobe", "phong-approx"},
                                               {"--shadows", "--shadow-filter", "5"},
                                               {"--shadows", "--shadow-map-size", "256"}}) {
    const Report other = report({"builtin:shadows"}, join({options, more}));
    EXPECT_TRUE(other.cached().empty()) << more.back();
    EXPECT_NE(other.files.at("report.json"), plain.files.at("report.json")) << more.back();
  }
}

TEST_F(ResultCacheTest, BlocksOfTexturesCount) {
  base::Image8 checks(32, 32, 3);
  for (std::size_t i = 0; i < checks.pixels.size(); ++i) checks.pixels[i] = static_cast<std::uint8_t>(i * i % 251);
  base::writeImage8(m_folder / "checks.png", checks);
  const std::vector<std::string> scene = {writeScene("one", "checks.png")};
  std::string before = report(scene).files.at("report.json");
  for (const char* block : {"astc4x4", "astc6x6"}) {
    const std::vector<std::string> options = {"--mobile-textures", block};
    const Report first = report(scene, options), again = report(scene, options);
    EXPECT_TRUE(first.cached().empty()) << block;
    EXPECT_EQ(again.cached(), std::vector<std::string>{"one"}) << block;
    EXPECT_TRUE(again.files == first.files) << block;
    EXPECT_NE(first.files.at("report.json"), before) << block;
    before = first.files.at("report.json");
    const nlohmann::json view = nlohmann::json::parse(before)["scenes"][0]["views"][0];
    const nlohmann::json stage = view["whole"]["stages"].back(); // behind the render target's
    EXPECT_EQ(stage["stage"], "textures");
    EXPECT_EQ(stage["through"], block);
    EXPECT_GT(stage["figures"]["metrics"]["flip.mean"], 0) << block;
  }
}

TEST_F(ResultCacheTest, UnchangedScenesGiveTheSameBytesAndAreNotRendered) {
  paint("a.png", 200);
  const std::vector<std::string> scenes = {writeScene("one", "a.png"), writeQuad()};
  const Report first = report(scenes), again = report(scenes), uncached = report(scenes, {"--no-cache"});
  EXPECT_EQ(first.cached(), kNone);
  EXPECT_EQ(uncached.cached(), kNone);
  EXPECT_EQ(again.cached(), (std::vector<std::string>{"one", "quad-embedded"}));
  for (const char* stage : {"load scene", "upload", "surface", "shade mobile", "metrics", "encode images"}) {
    EXPECT_TRUE(first.did(stage)) << stage;
    EXPECT_FALSE(again.did(stage)) << stage;
  }
  EXPECT_TRUE(again.files == first.files);
  EXPECT_TRUE(uncached.files == first.files);
  EXPECT_EQ(again.run.exitCode, first.run.exitCode);
  EXPECT_EQ(again.run.err, first.run.err + "2 of 2 scenes are unchanged and come from the cache\n");
  EXPECT_FALSE(contains(again.files.at("report.json"), "cache"));
}

TEST_F(ResultCacheTest, SceneElsewhereInTheRunIsTheSameSceneWithOtherNames) {
  paint("a.png", 200);
  const std::string one = writeScene("one", "a.png"), two = writeQuad();
  report({one, two});
  const Report turned = report({two, one});
  EXPECT_EQ(turned.cached(), (std::vector<std::string>{"quad-embedded", "one"}));
  EXPECT_TRUE(turned.files == report({two, one}, {"--no-cache"}).files);
}

TEST_F(ResultCacheTest, ChangedTextureRendersOnlyTheScenesThatUseIt) {
  paint("a.png", 200);
  paint("b.png", 40);
  const std::vector<std::string> scenes = {writeScene("one", "a.png"), writeScene("two", "b.png"),
                                           writeScene("three", "a.png")};
  const Report before = report(scenes);
  paint("a.png", 10);
  const Report after = report(scenes);
  EXPECT_EQ(after.cached(), std::vector<std::string>{"two"});
  EXPECT_FALSE(after.files == before.files);
  EXPECT_TRUE(after.files == report(scenes, {"--no-cache"}).files);
  paint("a.png", 200); // and back: what it was before is still kept
  const Report back = report(scenes);
  EXPECT_EQ(back.cached().size(), 3u);
  EXPECT_TRUE(back.files == before.files);
}

TEST_F(ResultCacheTest, BufferAndEnvironmentCountByTheirContent) {
  paint("a.png", 200);
  const std::string scene = writeScene("one", "a.png");
  const std::string sky = path("sky.hdr");
  base::writeImage(sky, base::Image(8, 4, 3, 0.5f));
  EXPECT_EQ(report({scene}).cached(), kNone);
  EXPECT_EQ(report({scene}, {"--env", sky}).cached(), kNone);
  base::writeImage(sky, base::Image(8, 4, 3, 0.7f));
  EXPECT_EQ(report({scene}, {"--env", sky}).cached(), kNone);
  EXPECT_EQ(report({scene}, {"--env", sky}).cached().size(), 1u);
  std::string buffer = readWholeFile(m_folder / "one.bin");
  buffer[3] ^= 1; // of a position
  writeFile(m_folder / "one.bin", buffer);
  EXPECT_EQ(report({scene}).cached(), kNone);
}

TEST_F(ResultCacheTest, LinkThatLeadsElsewhereIsAnotherScene) {
  std::filesystem::create_directory(m_folder / "asset");
  paint("asset/a.png", 200);
  paint("outside.png", 200);
  std::filesystem::create_symlink("a.png", m_folder / "asset/paint.png");
  GltfFile file = makeQuad();
  file.json["images"] = {{{"uri", "paint.png"}}};
  file.json["textures"] = {{{"source", 0}}};
  file.material()["pbrMetallicRoughness"]["baseColorTexture"] = {{"index", 0}};
  const std::string scene = writeEmbedded(m_folder, std::move(file), "asset/scene");
  EXPECT_EQ(report({scene}).cached(), kNone);
  EXPECT_EQ(report({scene}).cached().size(), 1u);
  std::filesystem::remove(m_folder / "asset/paint.png");
  std::filesystem::create_symlink("../outside.png", m_folder / "asset/paint.png"); // the same content
  const RunResult refused = runParity(
      {"report", scene, "--size", "48x48", "--sun", "60,60,4", "--cache", cache().string(), "-q", "-o", path("last")});
  EXPECT_TRUE(exitedWith(4, refused)) << "the link leaves the asset's folder";
}

TEST_F(ResultCacheTest, ManyScenesShareTheShadersOfARun) {
  // Ten scenes: at most eight permutations a path; here none pays for one of its own.
  std::vector<std::string> scenes;
  for (int i = 0; i < 10; ++i) {
    GltfFile file = makeQuad();
    file.material()["pbrMetallicRoughness"]["metallicFactor"] = i % 2;
    if (i % 3 == 0) file.material()["extensions"]["KHR_materials_unlit"] = nlohmann::json::object();
    if (i % 3 == 0) file.json["extensionsUsed"] = {"KHR_materials_unlit"};
    if (i % 5 == 0) file.material()["alphaMode"] = "BLEND";
    scenes.push_back(writeEmbedded(m_folder, std::move(file), "scene" + std::to_string(i)));
  }
  const std::vector<std::string> options = {"--no-cache", "--attribution", "none"};
  const Report many = report(scenes, options);
  EXPECT_EQ(many.info["compiledShaders"], 2) << "one of each path, which asks at run time";
  const Report few = report({scenes[1], scenes[2], scenes[3]}, options);
  EXPECT_LE(few.info["compiledShaders"], 2 * 3);
  EXPECT_GT(few.info["compiledShaders"], 2);
}

TEST_F(ResultCacheTest, EveryKindOfOptionCounts) {
  const std::string scene = writeQuad();
  report({scene});
  EXPECT_EQ(report({scene}).cached().size(), 1u);
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--exposure", "1"},
                                                  {"--mobile-preset", "refit"},
                                                  {"--fresnel", "spherical-gaussian"},
                                                  {"--metrics", "flip,psnr"},
                                                  {"--fov", "44"},
                                                  {"--costs"}})
    EXPECT_EQ(report({scene}, options).cached(), kNone) << options.front();
}

TEST_F(ResultCacheTest, BudgetsJudgeWhatWasKept) {
  const auto budgets = [&](const std::string& limits) {
    return std::vector<std::string>{"--budgets", writeBudgets(m_folder, limits), "--attribution", "none"};
  };
  const std::string scene = writeQuad();
  const Report loose = report({scene}, budgets("fail = 0.999"));
  EXPECT_EQ(loose.run.exitCode, 0) << loose.run.err;
  const Report strict = report({scene}, budgets("fail = 1e-6"));
  EXPECT_EQ(strict.cached().size(), 1u);
  EXPECT_EQ(strict.run.exitCode, 2) << strict.run.err;
  EXPECT_TRUE(strict.files == report({scene}, join({budgets("fail = 1e-6"), {"--no-cache"}})).files);
}

TEST_F(ResultCacheTest, WhateverIsWrongWithTheCacheIsOneWarning) {
  const std::vector<std::string> scenes = {writeQuad()};
  const Report first = report(scenes);
  const auto spoil = [&](const auto& change) {
    for (const std::string& entry : listFiles(cache())) {
      const std::filesystem::path file = cache() / entry;
      writeFile(file, change(readWholeFile(file)));
    }
  };
  const auto expectMadeAnew = [&](const std::string& what) {
    const Report again = report(scenes);
    EXPECT_EQ(again.cached(), kNone) << what;
    EXPECT_TRUE(again.files == first.files) << what;
    EXPECT_EQ(again.run.exitCode, first.run.exitCode) << what;
    EXPECT_TRUE(contains(again.run.err, "warning: cache: ")) << what << "\n" << again.run.err;
  };
  spoil([](std::string content) { return content.substr(0, content.size() / 2); });
  expectMadeAnew("truncated");
  spoil([](std::string content) {
    content[content.size() - 3] ^= 1;
    return content;
  });
  expectMadeAnew("a bit turned");
  spoil([](const std::string&) { return std::string("another program's"); });
  expectMadeAnew("foreign");
  const Report whole = report(scenes);
  EXPECT_EQ(whole.cached().size(), 1u);
  EXPECT_FALSE(contains(whole.run.err, "warning"));
}

TEST_F(ResultCacheTest, CacheThatIsFullOrNoFolderIsOneWarning) {
  const std::vector<std::string> scenes = {writeQuad()};
  const Report first = report(scenes, {"--no-cache"});
  const Report small = report(scenes, {"--cache-size", "50"});
  EXPECT_TRUE(small.files == first.files);
  EXPECT_EQ(small.run.exitCode, first.run.exitCode);
  EXPECT_TRUE(contains(small.run.err, "warning: cache: ")) << small.run.err;
  EXPECT_EQ(listFiles(cache()), kNone);
  writeFile(cache(), std::string("in the way"));
  const Report blocked = report(scenes);
  EXPECT_TRUE(blocked.files == first.files);
  EXPECT_EQ(blocked.run.exitCode, first.run.exitCode);
  EXPECT_TRUE(contains(blocked.run.err, "warning: cache: ")) << blocked.run.err;
}

TEST_F(ResultCacheTest, TwoProcessesShareOne) {
  const std::filesystem::path folders[] = {m_folder / "a", m_folder / "b"};
  paint("a.png", 200);
  const std::string one = writeScene("one", "a.png"), two = writeQuad();
  RunResult results[2];
  const auto start = [&](int i) {
    results[i] = runParity({"report", one, two, "--size", "48x48", "--sun", "60,60,4", "--cache", cache().string(),
                            "--cache-size", "300K", "-o", folders[i].string()});
  };
  std::thread other(start, 1);
  start(0);
  other.join();
  EXPECT_EQ(results[0].exitCode, results[1].exitCode) << results[0].err << results[1].err;
  for (const RunResult& result : results) EXPECT_FALSE(contains(result.err, "warning: cache")) << result.err;
  const std::vector<std::string> files = listFiles(folders[0]);
  ASSERT_EQ(listFiles(folders[1]), files);
  for (const std::string& file : files)
    if (file == "report.json" || file.ends_with(".png") || file.ends_with(".js")) {
      EXPECT_TRUE(readWholeFile(folders[0] / file) == readWholeFile(folders[1] / file)) << file;
    }
}

TEST_F(ResultCacheTest, InfoCountsAndClearEmpties) {
  const auto run = [&](const char* command) {
    const RunResult result = runParity({"cache", command, "--cache", cache().string(), "--json", "-"});
    EXPECT_TRUE(exitedWith(0, result));
    return nlohmann::json::parse(result.out);
  };
  EXPECT_EQ(run("info")["entries"], 0) << "there is no such folder";
  report({writeQuad()}, {"--attribution", "none"});
  writeFile(cache() / "notes.txt", std::string("the user's own"));
  const nlohmann::json info = run("info");
  EXPECT_EQ(info["entries"], listFiles(cache()).size() - 1);
  std::map<std::string, int> kinds;
  for (const nlohmann::json& kind : info["kinds"]) kinds[kind["kind"]] = kind["entries"];
  EXPECT_EQ(kinds, (std::map<std::string, int>{{"files", 1}, {"lut", 1}, {"numerics", 1}, {"scene", 1}, {"time", 1}}));
  EXPECT_EQ(run("clear")["bytes"], info["bytes"]);
  EXPECT_EQ(listFiles(cache()), std::vector<std::string>{"notes.txt"});
  const RunResult refused = runParity({"cache", "info", "--cache", (cache() / "notes.txt").string()});
  expectRefused(refused, 4, {"notes.txt"});
}

} // namespace
} // namespace parity::tests
