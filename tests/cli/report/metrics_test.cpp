// --metrics: what a report measures, and that a report on some materials says the same of them as one on all.
#include <set>

#include "cli/checks.h"

namespace parity::tests {
namespace {

class MetricsTest : public RenderingTest {
protected:
  // The report's figures of a material of builtin:spheres, by name.
  nlohmann::json figuresOf(const std::string& material, const std::vector<std::string>& options) {
    const std::filesystem::path folder = m_folder / ("out" + std::to_string(m_reports++));
    const RunResult result =
        runParity(join({{"report", "builtin:spheres", "-o", folder.string()}, kSun, kSmall, options}));
    EXPECT_NE(result.exitCode, 4) << result.err;
    EXPECT_NE(result.exitCode, 64) << result.err;
    const nlohmann::json report = readReport(folder);
    for (const nlohmann::json& found : report["scenes"][0]["views"][0]["materials"])
      if (found["name"] == material) return found["figures"]["metrics"];
    ADD_FAILURE() << "no material " << material;
    return nullptr;
  }

private:
  int m_reports = 0;
};

std::set<std::string> namesOf(const nlohmann::json& figures) {
  std::set<std::string> names;
  for (const auto& [name, value] : figures.items()) names.insert(name);
  return names;
}

TEST_F(MetricsTest, AreThoseAskedForAndWhatTheBudgetsName) {
  const std::string budgets =
      writeBudgets(m_folder, "fail = 0.999"); // of mean FLIP; the built-in ones, which stand in, of p95 and EV
  EXPECT_EQ(namesOf(figuresOf("metal 1.0", {"--budgets", budgets, "--metrics", "deltae,ssim"})),
            (std::set<std::string>{"flip.mean", "flip.p95", "ssim.mean", "ssim.p05", "ssim.min", "deltae.mean",
                                   "deltae.p95", "deltae.max", "bias.ev"}));
}

TEST_F(MetricsTest, OfHdrAreMeasuredOnTheFrames) {
  const nlohmann::json figures = figuresOf("metal 1.0", {"--metrics", "hdrflip,relmse,msssim,maxabs"});
  for (const char* name : {"hdrflip.mean", "hdrflip.max", "relmse", "maxabs"})
    EXPECT_GT(figures.value(name, -1.), 0) << name;
  EXPECT_GT(figures.value("msssim", -1.), 0);
}

TEST_F(MetricsTest, OfAMaterialAreTheSameWhereTheOthersAreLeftOut) {
  const std::vector<std::string> metrics = {"--metrics", "flip,ssim,msssim,deltae,rmse,relmse,psnr,maxabs,bias"};
  const nlohmann::json all = figuresOf("metal 1.0", metrics),
                       alone = figuresOf("metal 1.0", join({metrics, {"--material", "metal 1.0"}}));
  ASSERT_EQ(namesOf(all), namesOf(alone));
  for (const auto& [name, value] : all.items())
    EXPECT_NEAR(value.get<double>(), alone[name].get<double>(), 1e-6 * (1 + std::abs(value.get<double>()))) << name;
}

} // namespace
} // namespace parity::tests
