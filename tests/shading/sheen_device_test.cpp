// The sheen's functions on the device against the same source on the CPU, at equal precision.
#include <array>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "shading/shading.h"
#include "shading_shaders/sheen_fp16.comp.h"
#include "shading_shaders/sheen_fp32.comp.h"
#include "study/stress/device_rows.h"
#include "support/device.h"

namespace parity::tests {
namespace {

constexpr std::uint32_t kSheenRows = 16384;
constexpr int kSheenValues = 5;
constexpr std::array<const char*, kSheenValues> kSheenNames = {"D_Charlie", "charlieLambda", "V_Charlie", "V_Neubelt",
                                                               "sheenAlbedoFit"};
using SheenValues = std::array<float, kSheenValues>;

#define PARITY_SHEEN_VALUES(space, Real)                                                                               \
  [](const float* x) {                                                                                                 \
    namespace at = shading::space;                                                                                     \
    const Real roughness(x[0]), NoV(x[1]), NoL(x[2]), NoH(x[3]), alpha = at::sheenAlpha(roughness);                    \
    return SheenValues{float(at::D_Charlie(alpha, NoH)), float(at::charlieLambda(alpha, NoV)),                         \
                       float(at::V_Charlie(alpha, NoV, NoL)), float(at::V_Neubelt(NoV, NoL)),                          \
                       float(at::sheenAlbedoFit(roughness, NoV))};                                                     \
  }

class SheenOnDevice : public DeviceTest {
protected:
  // Roughness and cosines, evenly or near an end, as halves.
  static std::vector<float> makeInputs() {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform;
    std::vector<float> inputs(4 * kSheenRows);
    for (float& x : inputs) {
      const float u = uniform(random), kind = uniform(random);
      x = kind < 0.05f ? 0 : kind < 0.1f ? 1 : kind < 0.3f ? std::exp2(-14 * u) : u;
      x = float(shading::Half(x));
    }
    return inputs;
  }

  // relative: of each function, over max(|value|, 1e-3).
  template <typename Cpu> void compare(gpu::Spirv shader, const Cpu& cpu, const SheenValues& relative) const {
    const std::vector<float> inputs = makeInputs();
    const std::vector<float> outputs =
        stress::DeviceRows(device(), std::move(shader), 0).run(inputs, kSheenRows, kSheenValues);
    SheenValues worst{};
    for (std::uint32_t row = 0; row < kSheenRows; ++row) {
      const SheenValues expected = cpu(inputs.data() + std::size_t{4} * row);
      for (int k = 0; k < kSheenValues; ++k) {
        const auto at = static_cast<std::size_t>(k);
        const float actual = outputs[std::size_t{kSheenValues} * row + at];
        ASSERT_TRUE(std::isfinite(actual) && actual >= 0) << kSheenNames[at] << " of row " << row << ": " << actual;
        worst[at] = std::max(worst[at], std::abs(actual - expected[at]) / std::max(std::abs(expected[at]), 1e-3f));
      }
    }
    for (std::size_t k = 0; k < worst.size(); ++k) {
      std::printf("  %-16s %.1e of its value (limit %.0e)\n", kSheenNames[k], worst[k], relative[k]);
      EXPECT_LE(worst[k], relative[k]) << kSheenNames[k];
    }
  }
};

// pow and exp2 of up to a hundred times a logarithm: their units in the last place grow by that.
TEST_F(SheenOnDevice, AgreesWithTheCpuInFp32) {
  compare(gpu::Spirv(kSheenFp32Comp), PARITY_SHEEN_VALUES(f32, float), {5e-5f, 1e-5f, 1e-5f, 0, 2e-6f});
}

TEST_F(SheenOnDevice, AgreesWithTheCpuInFp16) {
  if (!device().report().float16) GTEST_SKIP() << device().report().name << " has no shaderFloat16";
  compare(gpu::Spirv(kSheenFp16Comp), PARITY_SHEEN_VALUES(f16, shading::Half), {0.03f, 0.04f, 0.04f, 0, 0.004f});
}

} // namespace
} // namespace parity::tests
