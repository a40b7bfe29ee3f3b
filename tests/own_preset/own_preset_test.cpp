// A mobile preset with an environment BRDF of its own stands in every command once it is added.
#include <cstdlib>

#include "cli/checks.h"

namespace parity::tests {
namespace {

using nlohmann::json;

class OwnPreset : public RenderingTest {
protected:
  OwnPreset() { setenv("PARITY_EXECUTABLE", PARITY_WITH_LINEAR, 1); }
  ~OwnPreset() override { unsetenv("PARITY_EXECUTABLE"); }

  base::Image renderTerm(const std::string& term, const std::string& precision) {
    return render("builtin:spheres", "mobile",
                  {"--env", "builtin:studio", "--mobile-preset", "linear", "--precision", precision, "--term", term,
                   "--size", "64x64"});
  }
};

// A = (1 + R)/4 and B = (1 - NoV)/4 in all pixels but those of fully rough materials.
TEST_F(OwnPreset, ShadesByItsFormulaInBothPrecisions) {
  for (const auto& [precision, tolerance] : {std::pair{"fp32", 1e-6f}, std::pair{"fp16", 2e-3f}}) {
    const base::Image A = renderTerm("EnvBRDF.A", precision), B = renderTerm("EnvBRDF.B", precision),
                      E = renderTerm("EnvBRDF", precision), F0 = renderTerm("SpecPreEnvBrdf", precision),
                      roughness = renderTerm("Roughness", precision), NoV = renderTerm("NoV", precision);
    double seen = 0;
    for (std::size_t i = 0; i < A.pixels.size(); ++i) {
      if (A.pixels[i] == 0 || roughness.pixels[i] == 1) continue; // nothing is there, or it is fully rough
      ++seen;
      ASSERT_NEAR(A.pixels[i], 0.25f + 0.25f * roughness.pixels[i], tolerance) << precision;
      ASSERT_NEAR(B.pixels[i], 0.25f - 0.25f * NoV.pixels[i], tolerance) << precision;
      ASSERT_NEAR(E.pixels[i], F0.pixels[i] * A.pixels[i] + B.pixels[i], 2 * tolerance) << precision;
    }
    EXPECT_GT(seen, 1000) << precision;
  }
}

// Its mirrors are dark, which the report says with the cause; those of a built-in preset beside it are not.
TEST_F(OwnPreset, IsReportedAndFails) {
  const auto mirror = [&](const std::string& preset) {
    const std::string file = (m_folder / "diff.json").string();
    const RunResult result =
        runParity(join({{"diff", "builtin:spheres", "--env", "builtin:studio", "--mobile-preset", preset, "--material",
                         "metal 0.0", "--attribution", "all", "--json", file},
                        kSmall}));
    EXPECT_EQ(result.signal, 0) << result.err;
    return json::parse(readWholeFile(file)).at("scenes").at(0).at("views").at(0).at("materials").at(0);
  };
  const json own = mirror("linear"), ue4 = mirror("ue4-2020");
  EXPECT_EQ(own.at("verdict"), "fail");
  EXPECT_TRUE(contains(own.at("bias").get<std::string>(), "EV darker")) << own.at("bias");
  const json& terms = own.at("attribution").at("terms");
  const auto best = std::ranges::min_element(
      terms, {}, [](const json& term) { return term.at("flip").is_null() ? 1. : term.at("flip").get<double>(); });
  EXPECT_EQ(best->at("term"), "skySpecular");
  EXPECT_NE(ue4.at("verdict"), "fail");
}

TEST_F(OwnPreset, StandsInHelpKnobsBenchAndStress) {
  EXPECT_TRUE(contains(runParity({"report", "--help"}).out, "linear"));
  EXPECT_TRUE(contains(runParity({"knobs"}).out, "linear"));
  EXPECT_TRUE(contains(runParity({"bench", "--list"}).out, "linear fp16"));
  const std::string file = (m_folder / "stress.json").string();
  runParity({"stress", "--only", "renders", "--renders", "roughness*", "--scenes", "0", "--json", file});
  EXPECT_TRUE(contains(readWholeFile(file), "mobile linear fp16"));
}

// Nothing draws a formula that is known to the shader alone.
TEST_F(OwnPreset, IsRefusedByPlotInALine) {
  expectRefused(runParity({"plot", "env-brdf", "--mobile-preset", "linear", "-o", (m_folder / "plot").string()}), 64,
                {"mobile: has no environment BRDF"});
}

} // namespace
} // namespace parity::tests
