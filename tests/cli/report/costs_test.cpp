// --costs: what each path's shaders cost, in report.json and the table; and that nobody pays for it unasked.
#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;
using CostsTest = RenderingTest;

TEST_F(CostsTest, TellWhatAPixelOfEachPathTakes) {
  const std::string file = (m_folder / "report.json").string();
  const RunResult run = runParity(
      join({{"diff", "builtin:materials", "--env", "builtin:studio", "--costs", "--json", file}, kSmall, kSun}));
  EXPECT_EQ(run.signal, 0) << run.err;
  EXPECT_TRUE(contains(run.out, "scalar operations and")) << run.out;
  const json report = json::parse(readWholeFile(file));
  std::uint64_t pixels[2] = {}, operations[2] = {}, fetches[2] = {};
  for (const json& each : report.at("scenes").at(0).at("permutations")) {
    const json& cost = each.at("cost");
    const int path = each.at("path") == "mobile" ? 1 : 0;
    const std::uint64_t count = each.at("pixels");
    pixels[path] += count;
    operations[path] += count * (cost.at("fp32").get<std::uint64_t>() + cost.at("fp16").get<std::uint64_t>());
    fetches[path] += count * cost.at("fetches").get<std::uint64_t>();
    EXPECT_LE(each.at("samplers"), path == 1 ? 8 : 11)
        << "high-end: the environment, its panorama and its table besides";
    std::printf("  %s\n", each.dump().c_str());
  }
  EXPECT_EQ(pixels[0], pixels[1]) << "both shade the same surface";
  EXPECT_GT(pixels[0], 0u);
  EXPECT_LT(operations[1], operations[0]) << "mobile is the cheaper path";
  EXPECT_LT(fetches[1], fetches[0]);
}

TEST_F(CostsTest, AreCountedOnlyWhereTheyAreAskedFor) {
  const std::string file = (m_folder / "report.json").string();
  const RunResult run = runParity(join({{"diff", "builtin:spheres", "--json", file}, kSmall, kSun}));
  EXPECT_FALSE(contains(run.out, "scalar operations")) << run.out;
  const json permutations = json::parse(readWholeFile(file)).at("scenes").at(0).at("permutations");
  EXPECT_FALSE(permutations.empty());
  for (const json& each : permutations) {
    EXPECT_FALSE(each.contains("cost"));
    EXPECT_GT(each.at("pixels"), 0);
    EXPECT_TRUE(each.contains("samplers"));
  }
}

} // namespace
} // namespace parity::tests
