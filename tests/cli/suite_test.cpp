// parity suite list, and what of a suite reaches reports: by the program itself.
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "base/file.h"
#include "base/temp_folder.h"
#include "cli/run_parity.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class SuiteCommand : public testing::Test {
protected:
  SuiteCommand() {
    base::writeText(m_folder / "n.toml",
                    "name = \"night <1>\"\n[[view]]\nname = \"front\"\n[[view]]\nname = \"side\"\n"
                    "orbit = [90, 80, 0]\n[[scene]]\nfiles = [\"builtin:spheres\", \"builtin:lights\"]\n"
                    "[[override]]\nscenes = [\"lights\"]\ntags = [\"hero\"]\n");
  }
  std::string path(const std::string& file) const { return (m_folder / file).string(); }
  base::TempFolder m_folder;
};

TEST_F(SuiteCommand, ListsWhatWouldRun) {
  const RunResult all = runParity({"suite", "list", path("n.toml"), "--cache", path("cache")});
  EXPECT_EQ(all.exitCode, 0) << all.err;
  EXPECT_EQ(all.out, "lights   front, side  [hero]\nspheres  front, side\n"
                     "night <1>: 2 scenes, 4 views; no scene has been timed yet, so there is no estimate\n");
  const json part = json::parse(
      runParity({"suite", "list", path("n.toml"), "--only", "tag:hero", "--cache", path("cache"), "--json", "-"}).out);
  ASSERT_EQ(part.at("scenes").size(), 1u);
  EXPECT_EQ(part.at("scenes")[0].at("name"), "lights");
  EXPECT_EQ(part.at("scenes")[0].at("file"), "builtin:lights");
  EXPECT_EQ(part.at("scenes")[0].at("tags"), json({"hero"}));
  EXPECT_TRUE(part.at("seconds").is_null());
  base::writeText(m_folder / "b.toml", "[[scene]]\nname = \"a [x]\"\nfile = \"builtin:lights\"\ntags = [\"t\"]\n"
                                       "[[scene]]\nname = \"a (x)\"\nfile = \"builtin:lights\"\n");
  const json exact = json::parse(runParity({"suite", "list", path("b.toml"), "--only", "tag:t", "--json", "-"}).out);
  EXPECT_EQ(exact.at("scenes").size(), 1u) << "a tag means its scenes and no others of a like name";
  const RunResult unknown = runParity({"suite", "list", path("n.toml"), "--only", "tag:hera"});
  EXPECT_EQ(unknown.exitCode, 64);
  EXPECT_NE(unknown.err.find("--only: 'tag:hera': no scene has this tag; did you mean 'hero'?"), std::string::npos)
      << unknown.err;
  EXPECT_EQ(runParity({"suite", "list", path("none.toml")}).exitCode, 4);
}

// The name of the suite is in the report, in JUnit and on the page; a run gives `suite list` its times.
TEST_F(SuiteCommand, NameAndTimesOfARunAreKept) {
  const RunResult run =
      runParity(join({{"report", "--suite", path("n.toml"), "--only", "tag:hero", "--only", "spheres/side", "--size",
                       "32x32", "-o", path("out"), "--cache", path("cache"), "-q"},
                      kRoughSky}));
  EXPECT_TRUE(run.exitCode == 0 || run.exitCode == 2) << run.err;
  const json report = json::parse(base::readText(m_folder / "out/report.json"));
  EXPECT_EQ(report.at("suite"), "night <1>");
  EXPECT_EQ(report.at("scenes").size(), 2u);
  EXPECT_EQ(report.at("scenes")[0].at("views").size(), 2u);
  EXPECT_EQ(report.at("scenes")[1].at("views").size(), 1u);
  const std::string junit = base::readText(m_folder / "out/junit.xml");
  EXPECT_NE(junit.find("<testsuites name=\"night &lt;1&gt;\""), std::string::npos) << junit.substr(0, 300);
#ifdef PARITY_DASHBOARD
  const std::string page = base::readText(m_folder / "out/index.html");
  EXPECT_NE(page.find("<title>parity: night &lt;1&gt;: "), std::string::npos) << page.substr(0, 600);
#endif
  const std::string list = runParity({"suite", "list", path("n.toml"), "--cache", path("cache")}).out;
  EXPECT_NE(list.find("; about "), std::string::npos) << list;
  EXPECT_NE(list.find("(1 of 2 scenes timed"), std::string::npos) << "the other one had but one of its views: " << list;
}

} // namespace
} // namespace parity::tests
