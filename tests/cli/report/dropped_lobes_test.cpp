// What the lobes that a preset drops are worth: measured by default, for the materials that have them, and for no
// others.
#include <nlohmann/json.hpp>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class DroppedLobesTest : public RenderingTest {
protected:
  json report(const std::vector<std::string>& more) {
    const std::string out = (m_folder / "out").string();
    const RunResult result = runParity(join({{"report", "builtin:lobes", "-o", out, "--size", "144x120", "--env",
                                              "builtin:studio", "--attribution", "none", "--no-cache"},
                                             kRoughSky,
                                             more}));
    EXPECT_TRUE(exitedWith(2, result));
    m_text = result.out + result.err;
    return json::parse(readWholeFile(m_folder / "out" / "report.json"))["scenes"][0];
  }
  static json lobesOf(const json& scene, const std::string& material) {
    for (const json& each : scene["views"][0]["materials"])
      if (each["name"] == material) return each.value("droppedLobes", json::array());
    ADD_FAILURE() << material;
    return {};
  }
  static json passOf(const json& scene, const std::string& name) {
    for (const json& each : scene["passes"])
      if (each["name"] == name) return each;
    ADD_FAILURE() << name;
    return {};
  }
  std::string m_text;
};

TEST_F(DroppedLobesTest, AreMeasuredForTheMaterialsThatHaveThem) {
  const json scene = report({"--mobile-preset", "karis2014"});
  const json coat = lobesOf(scene, "coat 0.0"), sheen = lobesOf(scene, "sheen white 1.0"),
             both = lobesOf(scene, "coat on sheen");
  ASSERT_EQ(coat.size(), 1u);
  EXPECT_EQ(coat[0]["lobe"], "clear coat");
  EXPECT_GT(coat[0]["flip"], 0.05);
  ASSERT_EQ(sheen.size(), 1u);
  EXPECT_EQ(sheen[0]["lobe"], "sheen");
  EXPECT_GT(sheen[0]["flip"], 0.5) << "a white sheen over black is nearly all of its light";
  EXPECT_EQ(both.size(), 2u);
  const json brushed = lobesOf(scene, "anisotropy 0.2"), film = lobesOf(scene, "film 0.2");
  ASSERT_EQ(brushed.size(), 1u);
  EXPECT_EQ(brushed[0]["lobe"], "anisotropy");
  EXPECT_GT(brushed[0]["flip"], 0.02);
  ASSERT_EQ(film.size(), 1u);
  EXPECT_EQ(film[0]["lobe"], "iridescence");
  EXPECT_GT(film[0]["flip"], 0.05);
  const json glass = lobesOf(scene, "glass 0.2"), leaf = lobesOf(scene, "translucent 1.00");
  ASSERT_EQ(glass.size(), 1u);
  EXPECT_EQ(glass[0]["lobe"], "transmission");
  EXPECT_GT(glass[0]["flip"], 0.3) << "porcelain in place of glass";
  ASSERT_EQ(leaf.size(), 1u);
  EXPECT_EQ(leaf[0]["lobe"], "diffuse transmission");
  EXPECT_GT(leaf[0]["flip"], 0.05);
  EXPECT_EQ(passOf(scene, "dropped lobes")["count"], 6);
  EXPECT_TRUE(contains(m_text, "mobile drops the clear coat (FLIP ")) << m_text;
}

TEST_F(DroppedLobesTest, AreNoneWhereThePresetHasTheLobe) {
  const json scene = report({"--mobile-preset", "ue4-2020"});
  EXPECT_EQ(lobesOf(scene, "coat 0.0").size(), 0u) << "the engine has a coat";
  EXPECT_EQ(lobesOf(scene, "sheen 1.0").size(), 1u) << "and no sheen";
  EXPECT_EQ(lobesOf(scene, "glass 0.2").size(), 0u) << "glass is blended";
  EXPECT_EQ(passOf(scene, "dropped lobes")["count"], 4);
}

TEST_F(DroppedLobesTest, AreNotMeasuredWhereTheRunAsksForNone) {
  const json scene = report({"--mobile-preset", "karis2014", "--dropped-lights", "0"});
  EXPECT_EQ(lobesOf(scene, "coat 0.0").size(), 0u);
  EXPECT_EQ(passOf(scene, "dropped lobes")["skipped"], "not requested");
}

} // namespace
} // namespace parity::tests
