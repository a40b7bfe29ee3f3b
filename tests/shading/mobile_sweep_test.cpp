// The mobile presets over their whole domain on the device: what is not finite or negative, and where.
#include <algorithm>
#include <cstdint>
#include <cstdio>

#include <gtest/gtest.h>

#include "shading_shaders/sweep_fp16.comp.h"
#include "shading_shaders/sweep_fp32.comp.h"
#include "study/stress/device_rows.h"
#include "support/device.h"

namespace parity::tests {
namespace {

constexpr std::uint32_t kPointsOfRow = 256, kRows = 10'000'000 / kPointsOfRow + 1; // of sweep.glsl; 10^7 points
constexpr int kKaris2014 = 0, kUe42020 = 1, kRefit = 2, kPhongApprox = 3;          // the last: karis2014 with it

struct Findings {
  double notANumber = 0, infinite = 0, negative = 0; // values, of four a point
  float greatestRoughness = -1;                      // of the points that have any that is not finite
  float leastRoughness = 2, greatestF0 = -1;         // of those that have a negative one
};

// What each point of the sequence came to, summed up.
class MobileSweep : public DeviceTest {
protected:
  Findings sweep(int preset, bool half) const {
    constexpr std::uint32_t kStride = 6;
    const gpu::Spirv shader = half ? gpu::Spirv(kSweepFp16Comp) : gpu::Spirv(kSweepFp32Comp);
    const float unused = 0;
    const std::vector<float> rows = stress::DeviceRows(device(), shader, preset).run({&unused, 1}, kRows, kStride);
    Findings found;
    for (std::uint32_t r = 0; r < kRows; ++r) {
      const float* row = rows.data() + std::size_t{r} * kStride;
      found.notANumber += row[0];
      found.infinite += row[1];
      found.negative += row[2];
      found.greatestRoughness = std::max(found.greatestRoughness, row[3]);
      found.leastRoughness = std::min(found.leastRoughness, row[4]);
      found.greatestF0 = std::max(found.greatestF0, row[5]);
    }
    std::printf(
        "  preset %d in %s: %.0f NaN, %.0f infinite, at roughness up to %g; %.0f negative, at roughness from %g and "
        "F0 up to %g\n",
        preset, half ? "fp16" : "fp32", found.notANumber, found.infinite, found.greatestRoughness, found.negative,
        found.leastRoughness, found.greatestF0);
    return found;
  }

  void expectClean(int preset, bool half) const {
    const Findings found = sweep(preset, half);
    EXPECT_EQ(found.notANumber, 0);
    EXPECT_EQ(found.infinite, 0);
    EXPECT_EQ(found.negative, 0);
  }

  bool hasHalf() const { return device().report().float16; }
};

TEST_F(MobileSweep, Ue42020IsFiniteAndNotNegativeInSingle) { expectClean(kUe42020, false); }
TEST_F(MobileSweep, RefitIsFiniteAndNotNegativeInSingle) { expectClean(kRefit, false); }
TEST_F(MobileSweep, Ue42020IsFiniteAndNotNegativeInHalf) {
  if (!hasHalf()) GTEST_SKIP() << "no shaderFloat16";
  expectClean(kUe42020, true);
}
TEST_F(MobileSweep, RefitIsFiniteAndNotNegativeInHalf) {
  if (!hasHalf()) GTEST_SKIP() << "no shaderFloat16";
  expectClean(kRefit, true);
}

// With the engine's form of the lobe nothing is infinite; B of EnvBRDFApprox stays negative where it was.
TEST_F(MobileSweep, PhongApproxMendsWhatDApproxFailsAt) {
  for (const bool half : {false, true}) {
    if (half && !hasHalf()) GTEST_SKIP() << "no shaderFloat16";
    const Findings found = sweep(kPhongApprox, half);
    EXPECT_EQ(found.notANumber, 0);
    EXPECT_EQ(found.infinite, 0);
    EXPECT_LT(found.greatestF0, 0.006);
  }
}

// docs/shading.md 4: 1/R^4 is infinite at R = 0 in single; and B falls to -0.0024 at R = 1, which F0 = 0 does not hide.
TEST_F(MobileSweep, Karis2014FailsInSingleOnlyWhereItsFormulasDo) {
  const Findings found = sweep(kKaris2014, false);
  EXPECT_GT(found.notANumber, 0);
  EXPECT_EQ(found.greatestRoughness, 0);
  EXPECT_GT(found.negative, 0);
  EXPECT_GT(found.leastRoughness, 0.7);
  EXPECT_LT(found.greatestF0, 0.006); // 0.0024 / 0.4524
}

// "D_Approx with the article's types: inf for R <= .0625 at RoL = 1, NaN for R <= .0574".
TEST_F(MobileSweep, Karis2014FailsInHalfOnlyWhereItsFormulasDo) {
  if (!hasHalf()) GTEST_SKIP() << "no shaderFloat16";
  const Findings found = sweep(kKaris2014, true);
  EXPECT_GT(found.notANumber, 0);
  EXPECT_GT(found.infinite, 0);
  EXPECT_GT(found.greatestRoughness, 0.0574);
  EXPECT_LE(found.greatestRoughness, 0.0626);
  EXPECT_LT(found.greatestF0, 0.006);
}

} // namespace
} // namespace parity::tests
