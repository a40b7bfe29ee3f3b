// Names of figures and metrics: what is known, how it is spelt, and what an unknown one is told.
#include <set>

#include <gtest/gtest.h>

#include "base/expect_error.h"
#include "compare/metrics/metric.h"
#include "compare/pooling/figure_list.h"
#include "compare/pooling/figures.h"
#include "error_code.h"

namespace parity::compare {
namespace {

TEST(Statistic, EveryRegisteredFigureIsFoundByItsNameAndSaysHowToReadIt) {
  std::set<std::string> names;
  for (const Metric& metric : metricRegistry()) {
    EXPECT_FALSE(metric.description.empty());
    ASSERT_FALSE(metric.statistics.empty());
    for (const Statistic& statistic : metric.statistics) {
      EXPECT_TRUE(names.insert(statistic.name).second) << statistic.name << " is there twice";
      EXPECT_EQ(statistic.metric, metric.name);
      EXPECT_TRUE(statistic.name == metric.name || statistic.name.starts_with(metric.name + "."));
      EXPECT_FALSE(statistic.label.empty());
      EXPECT_LT(statistic.least, statistic.most);
      const std::shared_ptr<const Statistic> found = statisticByName(statistic.name);
      ASSERT_TRUE(found);
      EXPECT_EQ(found->label, statistic.label);
    }
  }
  for (const char* name : {"flip.mean", "flip.p50", "flip.p95", "flip.p99", "flip.max", "rmse", "relmse", "psnr",
                           "maxabs", "bias.ev", "bias.dl", "bias.da", "bias.db"})
    EXPECT_TRUE(names.count(name)) << name;
}

TEST(Statistic, FractionOverIsKnownForAnyThresholdInRangeInOneSpelling) {
  for (const char* spelling : {"flip.fraction_over(0.1)", "flip.fraction_over(0.10)", "flip.fraction_over(1e-1)"}) {
    const std::shared_ptr<const Statistic> found = statisticByName(spelling);
    ASSERT_TRUE(found) << spelling;
    EXPECT_EQ(found->name, "flip.fraction_over(0.1)");
    EXPECT_EQ(found->label, "share of pixels with FLIP over 0.1");
    EXPECT_EQ(found->most, 1);
  }
  EXPECT_EQ(statisticByName("flip.fraction_over(0)")->name, "flip.fraction_over(0)");
  for (const char* wrong :
       {"flip.fraction_over()", "flip.fraction_over(x)", "flip.fraction_over(nan)", "flip.fraction_over(inf)",
        "flip.fraction_over(1)", "flip.fraction_over(-0.1)", "flip.fraction_over(0.1", "flip.fraction_over(0.1) ",
        "flip.fraction_over(0.1x)", "psnr.fraction_over(1)", "fraction_over(0.1)", ".fraction_over(0.1)", "flip", "",
        "FLIP.mean"})
    EXPECT_FALSE(statisticByName(wrong)) << wrong;
}

TEST(Statistic, ALimitAtTheEndOfTheRangeCanNotBeBeyond) {
  const auto can = [](const char* name, double limit) { return canBeBeyond(*statisticByName(name), limit); };
  EXPECT_FALSE(can("flip.mean", 1));
  EXPECT_TRUE(can("flip.mean", 0.9999));
  EXPECT_FALSE(can("flip.fraction_over(0.2)", 1));
  EXPECT_FALSE(can("psnr", 0));
  EXPECT_TRUE(can("psnr", 1e-9));
  EXPECT_FALSE(can("ssim.mean", -1));
  EXPECT_TRUE(can("ssim.mean", -0.999));
  EXPECT_TRUE(can("relmse", 1e300)) << "it has no end";
  EXPECT_TRUE(can("bias.ev", 1e300));
  EXPECT_FALSE(can("bias.dl", 100));
}

TEST(Statistic, AnUnknownNameIsToldTheNearestKnownOne) {
  base::expectError([] { requireStatistic("flip.men", "budgets.toml"); }, {"budgets.toml: ", "'flip.mean'"},
                    base::ExitCode::usage);
  const std::vector<std::string> known = knownStatistics();
  EXPECT_NE(std::find(known.begin(), known.end(), "flip.fraction_over(X)"), known.end());
}

TEST(MetricNames, AreParsedIntoTheRegistrysOrderEachOnce) {
  EXPECT_EQ(parseMetricNames("psnr,flip,psnr", "--metrics"), (std::vector<std::string>{"flip", "psnr"}));
  for (const char* wrong : {"", ",", "flip,", ",flip", "flip,,psnr", "flip psnr", "Flip"})
    EXPECT_EQ(test::codeOf([&] { parseMetricNames(wrong, "--metrics"); }), base::ExitCode::usage) << wrong;
  base::expectError([] { parseMetricNames("flip,pnsr", "--metrics"); }, {"'psnr'"}, base::ExitCode::usage);
  EXPECT_EQ(parseMetricNames("ssim.mean,flip.p95,flip.fraction_over(0.1)", "--metrics"),
            (std::vector<std::string>{"flip", "ssim"}))
      << "a figure names its metric";
}

TEST(FigureNames, AreParsedInTheirOrderAndAMetricStandsForItsFirstFigure) {
  std::vector<std::string> names;
  for (const Statistic& figure : parseFigures("psnr,flip,flip.p95,flip.fraction_over(0.10)", "--metrics"))
    names.push_back(figure.name);
  EXPECT_EQ(names, (std::vector<std::string>{"psnr", "flip.mean", "flip.p95", "flip.fraction_over(0.1)"}));
  base::expectError([] { parseFigures("flip,flip.men", "--metrics"); }, {"--metrics", "did you mean 'flip.mean'?"},
                    base::ExitCode::usage);
  base::expectError([] { parseFigures("nothing.at.all", "--metrics"); }, {"known: flip, hdrflip"},
                    base::ExitCode::usage);
}

TEST(Figures, AreFoundByName) {
  Figures figures;
  figures.values = {{"flip.mean", 0.25}, {"psnr", 30}};
  EXPECT_EQ(figures.find("psnr"), 30);
  EXPECT_FALSE(figures.find("flip.max"));
}

} // namespace
} // namespace parity::compare
