// The keys `baked` and `captures` of a suite file: baked by it, reported by it.
#include "cli/bake/bake_harness.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class BakeSuiteTest : public BakedRenderTest {
protected:
  std::string writeSuite(const std::string& text) const {
    writeFile(m_folder / "suite.toml", text);
    return path("suite.toml");
  }
  RunResult bakeSuite(const std::vector<std::string>& options = {}) const {
    return run(join({{"bake", "--suite", path("suite.toml"), "--texels-per-metre", "4", "--error", "20%",
                      "--max-samples", "512", "--capture-size", "32"},
                     options}));
  }
  RunResult reportSuite(const std::vector<std::string>& options = {}) const {
    return run(join({{"report", "--suite", path("suite.toml"), "--size", "48x48", "-o", path("report")}, options}));
  }
};

TEST_F(BakeSuiteTest, BakesWhatNamesAFolderAndReportsByIt) {
  writeEmbedded(m_folder, makeLitCorner(), "a");
  writeEmbedded(m_folder, makeLitCorner(), "b");
  writeSuite(R"(
[[scene]]
name = "with captures"
file = "a-embedded.gltf"
baked = "light/a"
captures = [[0, 0.5, 0], [0.5, 1, 0.5]]
[[scene]]
name = "plain"
file = "b-embedded.gltf"
[[scene]]
name = "with a sun"
file = "b-embedded.gltf"
sun = [30, 50, 4]
baked = "light/b"
)");
  const RunResult baked = bakeSuite({"--captures", "0"});
  ASSERT_TRUE(exitedWith(0, baked));
  EXPECT_TRUE(contains(baked.out, "2 environment captures")) << baked.out;
  const json manifest = json::parse(readWholeFile(m_folder / "light" / "a" / "manifest.json"));
  ASSERT_EQ(manifest.at("captures").size(), 2u);
  EXPECT_EQ(manifest.at("captures")[0].at("position"), json({0.0, 0.5, 0.0}));
  EXPECT_EQ(manifest.at("captures")[1].at("position"), json({0.5, 1.0, 0.5}));
  EXPECT_EQ(listFiles(m_folder / "light" / "b").size(), 7u) << "of its sun, no captures";
  const RunResult result = reportSuite();
  EXPECT_TRUE(result.exitCode == 0 || result.exitCode == 2) << result.err;
  const json report = readReport(m_folder / "report");
  ASSERT_EQ(report.at("scenes").size(), 3u);
  EXPECT_TRUE(contains(report.at("scenes")[0].at("light"), "baked"));
  EXPECT_FALSE(contains(report.at("scenes")[1].value("light", ""), "baked"));
  EXPECT_TRUE(contains(report.at("scenes")[2].at("light"), "baked"));
  // The one that cannot be shown fails alone.
  const RunResult truth = reportSuite({"--truth"});
  EXPECT_TRUE(exitedWith(4, truth));
  EXPECT_EQ(readReport(m_folder / "report").at("scenes").size(), 3u);
  EXPECT_TRUE(contains(truth.err, "the truth does not use baked light")) << truth.err;
  std::filesystem::remove_all(m_folder / "light" / "b");
  EXPECT_TRUE(exitedWith(4, reportSuite()));
  EXPECT_FALSE(readReport(m_folder / "report").at("scenes")[0].at("views").empty());
}

TEST_F(BakeSuiteTest, KeysThatMakeNoSenseNameTheLine) {
  const std::string head = "[[scene]]\nfile = \"builtin:room\"\n";
  const auto refused = [&](const std::string& text, const std::vector<std::string>& parts) {
    SCOPED_TRACE(text);
    writeSuite(text);
    expectRefused(bakeSuite({"-q"}), 4, parts);
  };
  refused(head, {"suite.toml", "no scene has this key"});
  refused(head + "baked = 3\n", {"line 3: baked: is not a string"});
  refused(head + "baked = \"\"\n", {"line 3: baked: is an empty string"});
  refused(head + "baked = \"x\"\ncaptures = [1, 2, 3]\n", {"line 4: captures"});
  refused(head + "baked = \"x\"\n[[scene]]\nname = \"other\"\nfile = \"builtin:room\"\nbaked = \"y/../x\"\n",
          {"suite.toml", "'room' and 'other' have the same folder"});
  EXPECT_EQ(entries(), std::vector<std::string>{"suite.toml"});
}

} // namespace
} // namespace parity::tests
