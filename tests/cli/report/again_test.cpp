// "To see it again": the commands of a report, run by a shell, give the very same rows.
#include <cstdio>
#include <regex>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class AgainTest : public RenderingTest {
protected:
  // Runs a command line as a shell reads it; `parity` is the program under test. Its report as JSON.
  nlohmann::json runByShell(const std::string& command) const {
    const std::string prefix = "parity diff ";
    EXPECT_TRUE(command.starts_with(prefix)) << command;
    // The shell splits the words, one a line.
    const std::string split = "printf '%s\\n' " + command.substr(std::string("parity ").size());
    std::vector<std::string> words;
    FILE* pipe = popen(split.c_str(), "r");
    std::string word;
    for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) {
      if (c != '\n') word += static_cast<char>(c);
      if (c == '\n') words.push_back(std::exchange(word, ""));
    }
    EXPECT_EQ(pclose(pipe), 0);
    const RunResult result = runParity(join({words, {"--json", path("again.json")}}));
    EXPECT_TRUE(std::filesystem::exists(path("again.json"))) << command << "\n" << result.err;
    return nlohmann::json::parse(readWholeFile(m_folder / "again.json"));
  }
  nlohmann::json runInfo() const { return nlohmann::json::parse(readWholeFile(m_folder / "out" / "run.json")); }

  void expectSameRows(const nlohmann::json& report) const {
    const nlohmann::json run = runInfo();
    std::size_t commands = 0;
    for (const nlohmann::json& scene : report["scenes"])
      for (const nlohmann::json& view : scene["views"])
        for (const nlohmann::json& each : run["again"]) {
          if (each["scene"] != scene["name"] || each["view"] != view["name"]) continue;
          ++commands;
          const nlohmann::json again = runByShell(each["command"].get<std::string>());
          ASSERT_EQ(again["scenes"].size(), 1u) << each;
          ASSERT_EQ(again["scenes"][0]["views"].size(), 1u) << each;
          const nlohmann::json& same = again["scenes"][0]["views"][0];
          EXPECT_EQ(same["name"], view["name"]);
          EXPECT_EQ(same["whole"]["figures"], view["whole"]["figures"]) << each;
          ASSERT_EQ(same["materials"].size(), view["materials"].size());
          for (std::size_t i = 0; i < same["materials"].size(); ++i)
            EXPECT_EQ(same["materials"][i]["figures"], view["materials"][i]["figures"]) << each;
        }
    EXPECT_EQ(commands, run["again"].size());
  }
};

TEST_F(AgainTest, ACommandOfASuiteGivesTheSameRows) {
  const std::string suite = write("my suite.toml", R"(
[defaults]
environment = "builtin:studio"
[[scene]]
name = "it's [a] scene"
file = "builtin:materials"
[[scene.view]]
name = "front"
[[scene.view]]
name = "left side"
orbit = [60, 70, 0]
[[scene]]
file = "builtin:spheres"
)");
  ASSERT_TRUE(isReported(runParity(join({{"report", "--suite", suite, "-o", path("out"), "--mobile-preset", "refit",
                                          "--exposure", "-1", "-q", "--single-file", "--json", path("x.json")},
                                         kSmall}))));
  expectSameRows(readReport(m_folder / "out"));
}

TEST_F(AgainTest, ACommandOfScenesGivesTheSameRows) {
  ASSERT_TRUE(isReported(
      runParity(join({{"report", "builtin:spheres", "builtin:materials", "--env", "builtin:studio", "--sun", "30,50,4",
                       "--no-sun-extraction", "--orbit", "30,60,0", "--annotate", "github", "--all", "-o", path("out")},
                      kSmall}))));
  expectSameRows(readReport(m_folder / "out"));
}

TEST_F(AgainTest, ACommandOfChosenMaterialsGivesTheSameRows) {
  ASSERT_TRUE(isReported(runParity(join({{"report", "builtin:materials", "--env", "builtin:studio", "--material", "g*",
                                          "--material", "rubber", "-o", path("out")},
                                         kSmall}))));
  expectSameRows(readReport(m_folder / "out"));
}

TEST_F(AgainTest, ACommandOfSeveralEnvironmentsFindsTheRowsOfTheBaseline) {
  const std::vector<std::string> scenes = {"report",      "builtin:furnace", "--env",
                                           "builtin:sky", "--env",           "builtin:studio"};
  ASSERT_TRUE(isReported(runParity(join({scenes, kSmall, {"-o", path("before")}}))));
  ASSERT_TRUE(isReported(runParity(join({scenes, kSmall, {"-o", path("out"), "--baseline", path("before")}}))));
  const nlohmann::json report = readReport(m_folder / "out");
  expectSameRows(report);
  const nlohmann::json again = runByShell(runInfo()["again"][1]["command"].get<std::string>());
  EXPECT_EQ(again["baseline"]["error"], "") << runInfo()["again"][1];
  EXPECT_EQ(again["scenes"][0]["name"], report["scenes"][1]["name"]);
}

TEST_F(AgainTest, AMaterialsCommandShowsItsRowAlone) {
  const std::vector<std::string> command = {"report", "builtin:materials", "--env", "builtin:studio",
                                            "-o",     path("out")};
  const RunResult result = runParity(join({command, kSmall}));
  ASSERT_TRUE(isReported(result));
  const nlohmann::json materials = readReport(m_folder / "out")["scenes"][0]["views"][0]["materials"];
  // What the terminal was given.
  std::smatch found;
  ASSERT_TRUE(
      std::regex_search(result.out, found, std::regex("to see it again:\n  (parity diff [^\n]*--material [^\n]*)\n")))
      << result.out;
  const nlohmann::json again = runByShell(found[1])["scenes"][0]["views"][0]["materials"];
  ASSERT_EQ(again.size(), 1u) << found[1];
  const auto row = std::find_if(materials.begin(), materials.end(),
                                [&](const nlohmann::json& each) { return each["name"] == again[0]["name"]; });
  ASSERT_NE(row, materials.end());
  EXPECT_EQ(again[0]["figures"], (*row)["figures"]);
  EXPECT_EQ(again[0]["verdict"], (*row)["verdict"]);
  EXPECT_EQ(again[0]["reason"], (*row)["reason"]);
  EXPECT_NE(again[0]["verdict"], "pass") << "the worst row";
  EXPECT_TRUE(
      contains(readWholeFile(m_folder / "out" / "junit.xml"), "to see it again: parity diff builtin:materials "));
}

} // namespace
} // namespace parity::tests
