// What is refused of folders of baked light: stale, foreign and damaged ones, and places that cannot be written. All in
// words, and nothing is hurt or left behind. Baking ended by the user.
#include "base/file_size_limit.h"
#include "cli/bake/bake_harness.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class StaleBakeTest : public BakedRenderTest {
protected:
  RunResult renderWith(const std::string& scene, const std::vector<std::string>& options) const {
    return run(join(
        {{"render", scene, "--path", "mobile", "--baked", path("baked"), "-o", path("out.png")}, kSmall, options}));
  }
  void expectStale(const std::string& scene, const std::vector<std::string>& options,
                   const std::string& changed) const {
    SCOPED_TRACE(changed);
    expectRefused(renderWith(scene, options), 4,
                  {path("baked"), "is stale: the " + changed + " changed after the bake", "parity bake"});
    EXPECT_FALSE(std::filesystem::exists(m_folder / "out.png"));
  }
};

TEST_F(StaleBakeTest, NamesWhatIsNotAsItWas) {
  GltfFile file = makeLitCorner();
  const std::string scene = writeEmbedded(m_folder, file);
  const std::vector<std::string> sky = {"--env", "builtin:studio"};
  bake({scene}, "baked", sky);
  EXPECT_TRUE(exitedWith(0, renderWith(scene, sky)));
  std::filesystem::remove(m_folder / "out.png");
  expectStale(scene, join({sky, {"--env-rotation", "40"}}), "environment");
  expectStale(scene, {"--env", "builtin:white"}, "environment");
  expectStale(scene, join({sky, {"--sky-light-color", "1,1,2"}}), "environment");
  expectStale(scene, {}, "environment");
  expectStale(scene, join({sky, kSun}), "lights");
  GltfFile other = file;
  other.json["nodes"][2]["translation"][0] = 0.3;
  expectStale(writeEmbedded(m_folder, other, "moved-lamp"), sky, "lights");
  other = file;
  other.json["nodes"][1]["translation"][1] = 0.01;
  expectStale(writeEmbedded(m_folder, other, "moved"), sky, "geometry");
  other = file;
  other.material()["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 0.99, 1};
  expectStale(writeEmbedded(m_folder, other, "painted"), sky, "materials");
  other.json["nodes"][1]["translation"][1] = 0.01;
  expectStale(writeEmbedded(m_folder, other, "both"), kSun, "geometry, materials, lights, environment");
  // What light does not depend on may change: names, views, the exposure.
  file.material()["name"] = "another";
  EXPECT_TRUE(exitedWith(0, renderWith(writeEmbedded(m_folder, file, "named"), join({sky, {"--exposure", "1"}}))));
}

TEST_F(StaleBakeTest, ForeignFoldersAreRefused) {
  const std::string scene = writeEmbedded(m_folder, makeLitCorner());
  const auto refused = [&](const std::vector<std::string>& parts) { expectRefused(renderWith(scene, {}), 4, parts); };
  refused({path("baked"), "is not a folder of baked light"});
  writeFile(m_folder / "baked", std::string("a file"));
  refused({path("baked"), "is not a folder of baked light"});
  std::filesystem::remove(m_folder / "baked");
  std::filesystem::create_directory(m_folder / "baked");
  const std::string manifest = path("baked") + "/manifest.json";
  refused({manifest});
  for (const std::string text : {"[]", "{}", R"({"format": "other", "version": 1})"}) {
    writeFile(manifest, text);
    refused({manifest, "is not the manifest of a bake"});
  }
  for (const std::string text :
       {"", "{", R"({"format": 1})", R"({"format": "parity-bake"})", R"({"format": "parity-bake", "version": 1})"}) {
    writeFile(manifest, text);
    refused({manifest, "is damaged"});
  }
  writeFile(manifest, std::string(R"({"format": "parity-bake", "version": 2})"));
  refused({manifest, "version: is 2, but this program reads 1; bake again"});
}

TEST_F(StaleBakeTest, DamagedFilesAreNamed) {
  GltfFile file = makeLitCorner();
  const std::string scene = writeEmbedded(m_folder, file);
  const std::filesystem::path folder = m_folder / "baked";
  ASSERT_TRUE(exitedWith(0, run(join({{"bake", scene, "-o", folder.string()}, kCapturedBake, kSun}))));
  const FolderContent content = readFolder(folder);
  const auto refused = [&](const std::string& name, const std::string& part) {
    SCOPED_TRACE(name);
    expectRefused(renderWith(scene, kSun), 4, {(folder / name).string(), part});
  };
  for (const auto& [name, whole] : content) {
    if (name == "manifest.json" || name == "lightmap-0.exr" || name == "capture-0.exr") continue; // for people
    writeFile(folder / name, whole.substr(0, whole.size() / 2));
    refused(name, "truncated");
    std::string changed = whole;
    changed[changed.size() / 2] ^= 1;
    writeFile(folder / name, changed);
    refused(name, "it has changed");
    writeFile(folder / name, whole + "x");
    refused(name, "another file");
    std::filesystem::remove(folder / name);
    refused(name, "");
    std::filesystem::create_directory(folder / name);
    refused(name, "");
    std::filesystem::remove(folder / name);
    writeFile(folder / name, whole);
  }
  const std::string& manifest = content.at("manifest.json");
  writeFile(folder / "manifest.json", manifest.substr(0, manifest.size() / 2));
  refused("manifest.json", "is damaged");
  const auto refusedWith = [&](const std::string& key, const json& value, const std::string& part) {
    json edited = json::parse(manifest);
    edited[key] = value;
    writeFile(folder / "manifest.json", edited.dump());
    refused("manifest.json", part);
  };
  refusedWith("pageSide", 0, "out of range");
  refusedWith("pageSide", 1 << 30, "out of range");
  refusedWith("pages", -1, "");
  refusedWith("pages", 1e9, "out of range");
  refusedWith("pages", 2, "is not listed");
  refusedWith("transitionScale", 0, "out of range");
  refusedWith("transitionScale", nullptr, "is damaged");
  refusedWith("files", json::array(), "is not listed");
  refusedWith("captures", {{{"position", {0, 0}}}}, "is damaged");
  writeFile(folder / "manifest.json", manifest);
  EXPECT_TRUE(exitedWith(0, renderWith(scene, kSun)));
}

class BakeOutputTest : public BakeTest {
protected:
  std::string m_scene = writeEmbedded(m_folder, makeLitCorner());
};

TEST_F(BakeOutputTest, TakesThePlaceOfAnEarlierBakeAndOfNothingElse) {
  const std::filesystem::path folder = m_folder / "out";
  std::filesystem::create_directory(folder);
  bake({m_scene}, "out"); // into an empty one
  const FolderContent before = readFolder(folder);
  bake({m_scene}, "out", {"--bounces", "0"});
  EXPECT_FALSE(readFolder(folder) == before);
  bake({m_scene}, "out/");
  EXPECT_TRUE(readFolder(folder) == before);
  EXPECT_EQ(entries(), (std::vector<std::string>{"cache", "out", "scene-embedded.gltf"})) << "nothing left beside it";
  writeFile(folder / "notes.txt", std::string("the user's own"));
  const FolderContent kept = readFolder(folder);
  expectRefused(tryBake({m_scene}, "out"), 4, {folder.string(), "that no bake wrote"});
  EXPECT_TRUE(readFolder(folder) == kept);
  std::filesystem::remove(folder / "notes.txt");
  std::filesystem::create_directory(folder / "more");
  expectRefused(tryBake({m_scene}, "out"), 4, {folder.string(), "that no bake wrote"});
  std::filesystem::create_directory(m_folder / "user");
  writeFile(m_folder / "user" / "manifest.json", std::string("{}"));
  expectRefused(tryBake({m_scene}, "user"), 4, {path("user"), "that no bake wrote"});
  writeFile(m_folder / "file", std::string("a file"));
  expectRefused(tryBake({m_scene}, "file"), 4, {path("file"), "is not a folder"});
  expectRefused(run(join({{"bake", m_scene, "-o", m_folder.path().string()}, kQuickBake})), 4, {"that no bake wrote"});
}

TEST_F(BakeOutputTest, GoesWhereALinkLeads) {
  std::filesystem::create_directory(m_folder / "real");
  std::filesystem::create_directory_symlink("real", m_folder / "link");
  bake({m_scene}, "link");
  EXPECT_TRUE(std::filesystem::is_symlink(m_folder / "link"));
  EXPECT_TRUE(std::filesystem::exists(m_folder / "real" / "manifest.json"));
}

TEST_F(BakeOutputTest, LeavesNothingWhereItCannotBeWritten) {
  for (const std::string folder : {"/dev/full/out", "/dev/null", "/proc/out"}) {
    SCOPED_TRACE(folder);
    const RunResult result = run(join({{"bake", m_scene, "-q", "-o", folder}, kQuickBake}));
    expectRefused(result, 4, {folder});
  }
  const std::string name(300, 'x'); // longer than any file system takes
  expectRefused(tryBake({m_scene}, name, {"-q"}), 4, {"name too long"});
  bake({m_scene}, "out");
  const FolderContent before = readFolder(m_folder / "out");
  const std::vector<std::string> names = entries();
  for (const rlim_t bytes : {100, 1000, 3000}) { // the disk is full at the first file, or at a later one
    const base::FileSizeLimit full(bytes);
    const RunResult result =
        runParity(join({{"bake", m_scene, "-q", "--no-cache", "--bounces", "0", "-o", path("out")}, kQuickBake}));
    expectRefused(result, 4, {"out"});
    const RunResult fresh = runParity(join({{"bake", m_scene, "-q", "--no-cache", "-o", path("fresh")}, kQuickBake}));
    expectRefused(fresh, 4, {"fresh"});
  }
  EXPECT_TRUE(readFolder(m_folder / "out") == before);
  EXPECT_EQ(entries(), names);
}

// Some seconds' work.
class BakeCancelTest : public BakeTest {
protected:
  RunResult bakeSlowly(const std::string& folder, const RunOptions& options = {},
                       const std::vector<std::string>& more = {}) const {
    return run(join({{"bake", "builtin:room", "-o", path(folder), "--texels-per-metre", "5", "--max-samples", "1024",
                      "--error", "0.1%", "--captures", "0", "--threads", "2"},
                     more}),
               options);
  }
  static double raysOf(const RunResult& result) {
    const std::size_t end = result.out.find(" million rays");
    return end == std::string::npos ? 0 : std::stod(result.out.substr(result.out.rfind(' ', end - 1)));
  }
};

TEST_F(BakeCancelTest, LeavesNothingAndGoesOnFromItsCache) {
  RunOptions options;
  options.terminal = true; // where progress is shown
  options.interruptAt = "gathering";
  const RunResult cancelled = bakeSlowly("out", options);
  EXPECT_TRUE(exitedWith(4, cancelled));
  EXPECT_EQ(cancelled.out, "");
  EXPECT_TRUE(contains(cancelled.err, "error: bake: cancelled; the cache keeps the finished part")) << cancelled.err;
  EXPECT_EQ(entries(), std::vector<std::string>{"cache"});
  const RunResult second = bakeSlowly("out", {}, {"--timings"});
  ASSERT_TRUE(exitedWith(0, second));
  EXPECT_TRUE(contains(second.err, " ms  ")) << second.err;
  std::filesystem::remove_all(m_folder / "cache");
  const RunResult whole = bakeSlowly("whole");
  ASSERT_TRUE(exitedWith(0, whole));
  EXPECT_GT(raysOf(second), 0);
  EXPECT_LT(raysOf(second), 0.99 * raysOf(whole)) << second.out << whole.out;
  EXPECT_TRUE(readFolder(m_folder / "out") == readFolder(m_folder / "whole"));
  const RunResult again = bakeSlowly("out");
  EXPECT_FALSE(contains(again.out, "million rays")) << "all is in the cache";
  EXPECT_TRUE(readFolder(m_folder / "out") == readFolder(m_folder / "whole"));
}

} // namespace
} // namespace parity::tests
