// The rows of metrics: their roots and powers against the library's, and the same figures by every instruction set.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "base/simd_level.h"
#include "compare/flip/flip_simd.h"
#include "compare/metrics/measure.h"
#include "compare/metrics/vector_math.h"
#include "compare/pooling/region.h"

namespace parity::compare {
namespace {

double relativeError(float actual, double exact) { return std::fabs(static_cast<double>(actual) / exact - 1); }

TEST(RowMath, RootsAndPowersAreWithinWhatTheyPromise) {
  for (float x = 1e-3f; x <= 2.f; x *= 1.0003f) {
    ASSERT_LT(relativeError(fastCbrt(x), std::cbrt(static_cast<double>(x))), 4e-7) << x;
    ASSERT_LT(relativeError(fastPow(x, 2.4f), std::pow(static_cast<double>(x), static_cast<double>(2.4f))),
              4e-7 + 1.5e-7 * std::fabs(2.4 * std::log2(static_cast<double>(x))))
        << x;
  }
  for (float x = -126.f; x <= 126.f; x += 0.0371f)
    ASSERT_LT(relativeError(fastExp2(x), std::exp2(static_cast<double>(x))), 3e-7) << x;
}

class BestSimdLevelAgain {
public:
  ~BestSimdLevelAgain() { base::useSimdLevel(""); }
};

TEST(RowMath, TheFiguresAreTheSameToTheLastBitByEveryInstructionSet) {
  const BestSimdLevelAgain again;
  std::mt19937 random(6);
  base::Image reference(203, 97, 3), test(203, 97, 3);
  for (float& v : reference.pixels) v = static_cast<float>(random() % 1000) / 999.f;
  for (float& v : test.pixels) v = static_cast<float>(random() % 1000) / 999.f;
  base::PixelList list = wholeImage(203, 97);
  list.weights.assign(list.pixels.size(), 0.75f);
  const MeasureRequest request{.metrics = {"ssim", "msssim", "deltae", "rmse", "relmse", "psnr", "maxabs", "bias"},
                               .statistics = {"deltae.fraction_over(5)"}};
  std::vector<Figure> first;
  for (const std::string& level : base::simdLevels()) {
    base::useSimdLevel(level);
    const std::vector<Figure> values = measureRegions({reference, test}, {list}, request).regions[0].values;
    if (first.empty()) first = values;
    ASSERT_EQ(values.size(), first.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      EXPECT_EQ(values[i].value, first[i].value) << values[i].name << " by " << level;
  }
}

} // namespace
} // namespace parity::compare
