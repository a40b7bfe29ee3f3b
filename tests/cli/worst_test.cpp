// parity worst from end to end: what it prints is a scene of a suite, and that scene has the figure that was said.
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class WorstOnDevice : public RenderingTest {};

TEST_F(WorstOnDevice, PrintsASceneOfASuiteWithTheFigureItSays) {
  const std::vector<std::string> scene = {"builtin:materials", "--env",      "builtin:sky", "--sun",
                                          "30,50,4",           "--material", "gold"};
  const std::string file = path("worst.json");
  const std::vector<std::string> search = {"worst",  "--points", "16",        "--rotations", "2",
                                           "--size", "128x128",  "--timings", "--json",      file};
  const RunResult told = runParity(join({search, scene}));
  ASSERT_TRUE(exitedWith(0, told));
  EXPECT_TRUE(contains(told.err, "shade")) << told.err;
  const json found = json::parse(readWholeFile(file));
  const json& worst = found.at("views").at(0);
  EXPECT_EQ(worst.at("material"), "gold");
  EXPECT_GE(worst.at("pixels").get<int>(), 1000);
  EXPECT_GE(worst.at("flip").get<double>(), found.at("given").at("flip").get<double>());

  const std::string suite = write("suite.toml", told.out), report = path("diff.json");
  runParity({"diff", "--suite", suite, "--size", "128x128", "--json", report, "-q"});
  const json compared = json::parse(readWholeFile(report));
  double flip = -1;
  for (const json& each : compared.at("scenes").at(0).at("views").at(0).at("materials"))
    if (each.at("name") == "gold") flip = each.at("figures").at("metrics").at("flip.mean");
  EXPECT_NEAR(flip, worst.at("flip").get<double>(), 5e-3) << "the printed numbers are rounded";
}

TEST_F(WorstOnDevice, RefusesWhatItCannotTurnAndSlivers) {
  expectRefused(runParity({"worst", "builtin:furnace", "--env", "builtin:studio", "--size", "16x16", "--points", "8",
                           "--rotations", "1", "-q"}),
                3, {"no view shows 1000 pixels"});
  const RunResult usage = runParity({"worst", "builtin:furnace", "--points", "1"});
  EXPECT_TRUE(exitedWith(64, usage));
}

} // namespace
} // namespace parity::tests
