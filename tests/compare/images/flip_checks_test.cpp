// idiff's limits become checks on figures.
#include "compare/images/flip_checks.h"

#include <gtest/gtest.h>

#include "base/error.h"

namespace parity::compare {
namespace {

Threshold threshold(const std::string& metric) {
  Threshold t;
  t.metric = metric;
  return t;
}

TEST(FlipChecks, PooledFigureKeepsItsLimits) {
  Threshold t = threshold("psnr");
  t.fail = 30, t.warn = 35;
  const auto checks = makeChecks({t}, false);
  ASSERT_EQ(checks.size(), 1u);
  EXPECT_EQ(checks[0].statistic.name, "psnr");
  EXPECT_EQ(checks[0].fail, 30);
  EXPECT_EQ(checks[0].warn, 35);
}

TEST(FlipChecks, PixelwiseLimitIsAShareOfPixelsOverIt) {
  Threshold t = threshold("");
  t.fail = 0.1, t.failPercent = 2.5, t.warn = 0.05, t.hardFail = 0.9;
  const auto checks = makeChecks({t}, false);
  ASSERT_EQ(checks.size(), 3u);
  EXPECT_EQ(checks[0].statistic.name, "flip.fraction_over(0.1)");
  EXPECT_EQ(checks[0].fail, 0.025);
  EXPECT_EQ(checks[1].statistic.name, "flip.fraction_over(0.05)");
  EXPECT_EQ(checks[1].warn, 0.0);
  EXPECT_FALSE(checks[1].fail);
  EXPECT_EQ(checks[2].statistic.name, "flip.max");
  EXPECT_EQ(makeChecks({t}, true)[0].statistic.name, "hdrflip.fraction_over(0.1)");
}

TEST(FlipChecks, HardLimitOfAFigureIsOnItsMetricsWorstPixel) {
  Threshold t = threshold("flip.mean");
  t.hardFail = 0.5;
  EXPECT_EQ(makeChecks({t}, false)[0].statistic.name, "flip.max");
  t = threshold("ssim.mean");
  t.hardFail = 0.5;
  EXPECT_EQ(makeChecks({t}, false)[0].statistic.name, "ssim.min");
  t = threshold("psnr");
  t.hardFail = 30;
  EXPECT_THROW(makeChecks({t}, false), base::Error);
}

} // namespace
} // namespace parity::compare
