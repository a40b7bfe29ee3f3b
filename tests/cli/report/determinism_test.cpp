// Equal inputs give equal files, bit for bit: run again, with other threads, with and without a cache.
#include <map>
#include <regex>
#include <set>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class DeterminismTest : public RenderingTest {
protected:
  // Reports on two built-in scenes and returns the content of each file by its name.
  std::map<std::string, std::string> report(const std::string& name, const std::vector<std::string>& more = {},
                                            const RunOptions& options = {}) const {
    const std::filesystem::path folder = m_folder / name;
    const RunResult result =
        runParity(join({{"report", "builtin:lamps", "builtin:spheres", "--terms", "--samples", "2", "--budgets",
                         writeBudgets(m_folder, "fail = 0.999"), "-o", folder.string()},
                        kSun,
                        kSmall,
                        more}),
                  options);
    EXPECT_TRUE(exitedWith(0, result));
    std::map<std::string, std::string> files;
    for (const std::string& file : listFiles(folder)) files[file] = readWholeFile(folder / file);
    EXPECT_EQ(files.count("report.json"), 1u);
    EXPECT_GT(files.size(), 4u + 3 * 30) << "three pictures a view and a material";
    return files;
  }

  static void expectSame(const std::map<std::string, std::string>& a, const std::map<std::string, std::string>& b) {
    ASSERT_EQ(a.size(), b.size());
    for (const auto& [name, content] : a) {
      ASSERT_EQ(b.count(name), 1u) << name;
      if (name.ends_with(".png") || name.ends_with(".js") || name == "report.json") {
        EXPECT_TRUE(b.at(name) == content) << name << " differs";
      }
    }
  }
};

// The same command again, on one thread, with a cache that it fills and then finds filled, and without one. The
// validation layer is on, so no whole result is recalled.
TEST_F(DeterminismTest, NeitherTimeNorThreadsNorCacheShow) {
  const std::vector<std::string> cached = {"--cache", path("cache")};
  const auto filled = report("filled", cached);
  EXPECT_FALSE(listFiles(path("cache")).empty());
  const auto first = report("first", cached), second = report("second", cached);
  expectSame(first, filled);
  expectSame(first, second);
  expectSame(first, report("one", join({cached, {"--threads", "1"}})));
  expectSame(first, report("none", {"--no-cache"}));

  // Times, dates and the command line are in run.json and nowhere else.
  auto runs = std::make_pair(nlohmann::json::parse(first.at("run.json")), nlohmann::json::parse(second.at("run.json")));
  for (nlohmann::json* run : {&runs.first, &runs.second}) {
    EXPECT_TRUE(std::regex_match((*run)["startedAt"].get<std::string>(), std::regex("20..-..-..T..:..:..Z")));
    run->erase("startedAt");
    run->erase("commandLine");
    (*run)["origin"].erase("cpuSeconds");
    for (nlohmann::json& each : (*run)["sceneTimes"]) each.erase("seconds"), each.erase("cpuSeconds");
    // Two scenes at a time: which of them begins a stage first is chance.
    std::set<std::string> stages;
    for (const nlohmann::json& timing : (*run)["timings"]) stages.insert(timing["stage"].get<std::string>());
    (*run)["timings"] = stages;
  }
  EXPECT_EQ(runs.first, runs.second);

  const std::string& text = first.at("report.json");
  EXPECT_FALSE(contains(text, m_folder.path().string()));
  EXPECT_FALSE(std::regex_search(text, std::regex("20[0-9][0-9]-[01][0-9]-[0-3][0-9]")));
  EXPECT_FALSE(contains(text, "\"/")) << "an absolute path";
}

// Small pictures are shaded by less optimised code of the software driver: lobes, and textures, in single precision,
// too.
TEST_F(DeterminismTest, TheDriversOptimisationsDoNotShow) {
  const auto reportWith = [&](const std::string& effort, const std::string& precision) {
    RunOptions options;
    options.environment = {{"GALLIVM_PERF", effort}};
    const std::filesystem::path folder = m_folder / (effort + precision);
    EXPECT_TRUE(isReported(runParity(join({{"report", "builtin:lobes", "builtin:spheres", "--terms", "--no-cache",
                                            "--precision", precision, "-o", folder.string()},
                                           kSun,
                                           kSmall}),
                                     options)));
    std::map<std::string, std::string> files;
    for (const std::string& file : listFiles(folder)) files[file] = readWholeFile(folder / file);
    return files;
  };
  for (const std::string precision : {"fp16", "fp32"}) {
    const auto optimised = reportWith("", precision);
    EXPECT_EQ(optimised.count("report.json"), 1u);
    expectSame(optimised, reportWith("nopt", precision));
  }
}

// Each command that makes a device for a report's scenes, before it does.
TEST_F(DeterminismTest, SmallPicturesAskForLessOptimisation) {
  const std::string line = "the pictures are small: GALLIVM_PERF=nopt";
  const auto says = [&](const std::vector<std::string>& command) {
    const RunResult result = runParity(command);
    EXPECT_LE(result.exitCode, 2) << result.err;
    return contains(result.err, line);
  };
  const std::vector<std::string> room = {"builtin:furnace", "--no-cache", "-v"};
  EXPECT_TRUE(says(join({{"report"}, room, {"-o", path("small")}, kSmall})));
  EXPECT_TRUE(says(join({{"diff"}, room, kSmall})));
  EXPECT_FALSE(says(join({{"diff"}, room, {"--size", "512x513"}})));
  EXPECT_TRUE(says(join({{"plan"}, room, {"-o", path("plan")}, kSmall})));
  EXPECT_TRUE(says({"work", path("plan"), "--unit", "0", "-v"}));
  EXPECT_TRUE(says({"merge", path("plan"), "-o", path("merged"), "-v"}));
}

// Two at a time: scenes that fail or warn keep their places, on stderr too, and cost the others nothing. The last scene
// names a lobe, so that it is begun first.
TEST_F(DeterminismTest, BrokenScenesKeepTheirPlaces) {
  const std::string lobe = write("lobe.gltf", R"({"extensionsUsed": ["KHR_materials_sheen"]})");
  const auto run = [&](const std::string& threads) {
    const std::filesystem::path folder = m_folder / ("threads" + threads);
    const RunResult result =
        runParity(join({{"report", "no-such.gltf", "builtin:lamps", "gone.glb", "builtin:furnace", "lost.gltf", lobe,
                         "-o", folder.string(), "--threads", threads, "--no-cache"},
                        kSun,
                        kSmall}));
    EXPECT_TRUE(exitedWith(4, result));
    std::vector<std::string> messages;
    for (const std::string& line : linesOf(result.err))
      if (line.starts_with("error") || line.starts_with("warning")) messages.push_back(line);
    return std::pair(messages, readWholeFile(folder / "report.json"));
  };
  const auto one = run("1"), two = run("2");
  EXPECT_EQ(one, two);
  ASSERT_GE(one.first.size(), 4u);
  EXPECT_TRUE(contains(one.first.front(), "no-such.gltf")) << one.first.front();
  EXPECT_TRUE(contains(one.first[1], "lamps: mobile")) << one.first[1];
  EXPECT_TRUE(contains(one.first.back(), "lobe.gltf")) << one.first.back();
}

class CacheTest : public RenderingTest {};

TEST_F(CacheTest, NoCacheNeitherReadsNorWritesOne) {
  RunOptions options;
  options.environment = {{"XDG_CACHE_HOME", path("caches")}};
  const std::vector<std::string> command = join({{"diff", "builtin:furnace"}, kSmall});
  EXPECT_NE(runParity(join({command, {"--no-cache"}}), options).exitCode, 4);
  EXPECT_EQ(listFiles(m_folder / "caches" / "parity"), std::vector<std::string>());
  EXPECT_NE(runParity(command, options).exitCode, 4);
  EXPECT_FALSE(listFiles(m_folder / "caches" / "parity").empty());
}

TEST_F(CacheTest, DamagedEntryIsMadeAnewAndChangesNothing) {
  const std::filesystem::path cache = m_folder / "cache";
  const std::vector<std::string> command =
      join({{"diff", "builtin:furnace", "--json", "-", "--cache", cache.string()}, kSmall, kRoughSky});
  const RunResult filled = runParity(command);
  const std::vector<std::string> entries = listFiles(cache);
  ASSERT_FALSE(entries.empty());
  for (const std::string& entry : entries) {
    const std::string content = readWholeFile(cache / entry);
    writeFile(cache / entry, content.substr(0, content.size() / 2));
  }
  const RunResult again = runParity(command);
  EXPECT_EQ(again.exitCode, filled.exitCode) << again.err;
  EXPECT_TRUE(again.out == filled.out);
}

TEST_F(CacheTest, CacheThatCannotBeWrittenIsNoReasonToFail) {
  writeFile(m_folder / "file", std::string("in the way"));
  const RunResult result = runParity(join({{"diff", "builtin:furnace", "--cache", path("file")}, kSmall, kRoughSky}));
  EXPECT_NE(result.exitCode, 4) << result.err;
  EXPECT_TRUE(contains(result.out, "roughness 0.3"));
}

} // namespace
} // namespace parity::tests
